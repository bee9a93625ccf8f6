#pragma once

#include "simulation/linear/dense_front.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

// The innermost loop of a factorisation: columns of a front minus the product of eliminated ones, in tiles that stay in
// registers. One version for each kind of vector register. AVX2 and AVX-512 fuse multiplication and addition, by name
// and not by leave to the compiler, so that all builds give the same bits on one processor.

namespace myotact::simulation::tiles {

/// Columns [start, start + width), eliminated, with `scaled`: their L D, as far apart as the own columns.
template <class Scalar>
struct Eliminated {
  int start, width;      // columns of the front
  const Scalar* scaled;  // row 0 of the first of them
};

/// 16 bytes of plain vector arithmetic: SSE2, or what else there is. Each kind of register has the same: Value, its
/// kRows numbers, load and store anywhere in memory, a b + sum and a - b lane by lane.
template <class Scalar>
struct Plain {
  typedef Scalar Value __attribute__((vector_size(16), aligned(sizeof(Scalar)), may_alias));
  static constexpr int kRows = 16 / static_cast<int>(sizeof(Scalar));
  static Value zero() { return Value{}; }
  static Value load(const Scalar* from) { return *reinterpret_cast<const Value*>(from); }
  static void store(Scalar* to, const Value& value) { *reinterpret_cast<Value*>(to) = value; }
  static Value multiply_add(const Value& a, Scalar b, const Value& sum) { return sum + a * b; }
  static Value subtract(const Value& a, const Value& b) { return a - b; }
};

#if defined(__x86_64__)
#define MYOTACT_AVX2 [[gnu::target("avx2,fma")]]
#define MYOTACT_AVX512 [[gnu::target("avx512f,fma")]]

/// Eight floats in a register of AVX2. As the three below only for processors that have it (vector_unit()).
struct Avx2Float {
  using Value = __m256;
  static constexpr int kRows = 8;
  MYOTACT_AVX2 static Value zero() { return _mm256_setzero_ps(); }
  MYOTACT_AVX2 static Value load(const float* from) { return _mm256_loadu_ps(from); }
  MYOTACT_AVX2 static void store(float* to, const Value& value) { _mm256_storeu_ps(to, value); }
  MYOTACT_AVX2 static Value multiply_add(const Value& a, float b, const Value& sum) {
    return _mm256_fmadd_ps(a, _mm256_set1_ps(b), sum);
  }
  MYOTACT_AVX2 static Value subtract(const Value& a, const Value& b) { return _mm256_sub_ps(a, b); }
};

/// Four doubles.
struct Avx2Double {
  using Value = __m256d;
  static constexpr int kRows = 4;
  MYOTACT_AVX2 static Value zero() { return _mm256_setzero_pd(); }
  MYOTACT_AVX2 static Value load(const double* from) { return _mm256_loadu_pd(from); }
  MYOTACT_AVX2 static void store(double* to, const Value& value) { _mm256_storeu_pd(to, value); }
  MYOTACT_AVX2 static Value multiply_add(const Value& a, double b, const Value& sum) {
    return _mm256_fmadd_pd(a, _mm256_set1_pd(b), sum);
  }
  MYOTACT_AVX2 static Value subtract(const Value& a, const Value& b) { return _mm256_sub_pd(a, b); }
};

/// Sixteen floats in a register of AVX-512.
struct Avx512Float {
  using Value = __m512;
  static constexpr int kRows = 16;
  MYOTACT_AVX512 static Value zero() { return _mm512_setzero_ps(); }
  MYOTACT_AVX512 static Value load(const float* from) { return _mm512_loadu_ps(from); }
  MYOTACT_AVX512 static void store(float* to, const Value& value) { _mm512_storeu_ps(to, value); }
  MYOTACT_AVX512 static Value multiply_add(const Value& a, float b, const Value& sum) {
    return _mm512_fmadd_ps(a, _mm512_set1_ps(b), sum);
  }
  MYOTACT_AVX512 static Value subtract(const Value& a, const Value& b) { return _mm512_sub_ps(a, b); }
};

/// Eight doubles.
struct Avx512Double {
  using Value = __m512d;
  static constexpr int kRows = 8;
  MYOTACT_AVX512 static Value zero() { return _mm512_setzero_pd(); }
  MYOTACT_AVX512 static Value load(const double* from) { return _mm512_loadu_pd(from); }
  MYOTACT_AVX512 static void store(double* to, const Value& value) { _mm512_storeu_pd(to, value); }
  MYOTACT_AVX512 static Value multiply_add(const Value& a, double b, const Value& sum) {
    return _mm512_fmadd_pd(a, _mm512_set1_pd(b), sum);
  }
  MYOTACT_AVX512 static Value subtract(const Value& a, const Value& b) { return _mm512_sub_pd(a, b); }
};
#endif

// kColumns columns from j: rows from the diagonal on -= rows factors^T, kRegisters of them side by side as long as
// there are so many. A macro, because an intrinsic is inlined only into a function that names its target itself.
#define MYOTACT_STRIP(NAME, TARGET)                                                                                \
  template <class Register, int kColumns, int kRegisters, class Scalar>                                            \
  TARGET int NAME(const DenseFront<Scalar>& front, const Eliminated<Scalar>& by, int j, int first_row) {           \
    constexpr int kRows = kRegisters * Register::kRows;                                                            \
    const std::ptrdiff_t stride = front.stride(by.start), to_stride = front.stride(j);                             \
    int i = first_row;                                                                                             \
    for (; i + kRows - Register::kRows < front.size; i += kRows) {                                                 \
      const Scalar *row = by.scaled + i, *factor = front.column(by.start) + j;                                     \
      typename Register::Value sum[kRegisters][kColumns];                                                          \
      for (int r = 0; r < kRegisters; ++r) {                                                                       \
        for (int c = 0; c < kColumns; ++c) sum[r][c] = Register::zero();                                           \
      }                                                                                                            \
      for (int k = 0; k < by.width; ++k, row += stride, factor += stride) {                                        \
        for (int r = 0; r < kRegisters; ++r) {                                                                     \
          const typename Register::Value rows = Register::load(row + r * Register::kRows);                         \
          for (int c = 0; c < kColumns; ++c) sum[r][c] = Register::multiply_add(rows, factor[c], sum[r][c]);       \
        }                                                                                                          \
      }                                                                                                            \
      Scalar* to = front.column(j) + i;                                                                            \
      for (int c = 0; c < kColumns; ++c, to += to_stride) {                                                        \
        for (int r = 0; r < kRegisters; ++r) {                                                                     \
          Scalar* here = to + r * Register::kRows;                                                                 \
          Register::store(here, Register::subtract(Register::load(here), sum[r][c]));                              \
        }                                                                                                          \
      }                                                                                                            \
    }                                                                                                              \
    return i;                                                                                                      \
  }                                                                                                                \
  template <class Register, class Scalar>                                                                          \
  TARGET void NAME##_columns(const DenseFront<Scalar>& front, const Eliminated<Scalar>& by, int first, int last) { \
    int j = first;                                                                                                 \
    for (; j + 6 <= last; j += 6) {                                                                                \
      const int i = NAME<Register, 6, 2>(front, by, j, j);                                                         \
      NAME<Register, 6, 1>(front, by, j, i);                                                                       \
    }                                                                                                              \
    if (j < last) NAME<Register, 3, 1>(front, by, j, j);                                                           \
  }

MYOTACT_STRIP(plain, )
#if defined(__x86_64__)
MYOTACT_STRIP(avx2, MYOTACT_AVX2)
MYOTACT_STRIP(avx512, MYOTACT_AVX512)
#endif
#undef MYOTACT_STRIP

/// Columns [first, last) -= scaled L^T; first and last are multiples of 3 and on the same side of front.own.
template <class Scalar>
using UpdateColumns = void (*)(const DenseFront<Scalar>& front, const Eliminated<Scalar>& by, int first, int last);

}  // namespace myotact::simulation::tiles
