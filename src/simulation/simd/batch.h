#pragma once

#include <type_traits>

#include "simulation/simd/lanes.h"

// Elements are kept and computed eight at a time. How many of the eight go through the arithmetic at once depends on
// the processor; the result does not.

namespace myotact::simulation {

/// Elements of a batch.
inline constexpr int kBatch = 8;

/// One number of each of eight elements.
struct Eight {
  alignas(64) double lane[kBatch] = {};  // one an element
};

/// Kinds of vector registers, rising. Sse2 stands for whatever other processors have; the wider ones include FMA.
enum class VectorUnit { Sse2, Avx2, Avx512 };
/// The widest that this processor has and that is allowed. Any thread.
VectorUnit vector_unit();
/// For measurements: nothing wider is used from now on. Not while a step runs.
void allow_vector_unit(VectorUnit widest);

namespace detail {

/// A Real anywhere in memory where a double may be.
template <class Real>
struct Unaligned {
  typedef Real Type __attribute__((aligned(8), may_alias));
};

/// Whole and Part are one aggregate of numbers, such as TetShape, of Eight and of Real. Takes the lanes of Real that
/// begin at `part`, the first lane, out of the whole.
template <class Real, class Part, class Whole>
MYOTACT_INLINE void load(const Whole& whole, int part, Part& to) {
  static_assert(sizeof(Whole) / sizeof(Eight) == sizeof(Part) / sizeof(Real));
  const double* from = reinterpret_cast<const double*>(&whole) + part;
  Real* out = reinterpret_cast<Real*>(&to);
  for (std::size_t k = 0; k < sizeof(Part) / sizeof(Real); ++k) {
    out[k] = *reinterpret_cast<const typename Unaligned<Real>::Type*>(from + kBatch * k);
  }
}

/// Puts them back; the other lanes stay.
template <class Real, class Part, class Whole>
MYOTACT_INLINE void store(const Part& part_values, int part, Whole& whole) {
  static_assert(sizeof(Whole) / sizeof(Eight) == sizeof(Part) / sizeof(Real));
  double* to = reinterpret_cast<double*>(&whole) + part;
  const Real* from = reinterpret_cast<const Real*>(&part_values);
  for (std::size_t k = 0; k < sizeof(Part) / sizeof(Real); ++k) {
    *reinterpret_cast<typename Unaligned<Real>::Type*>(to + kBatch * k) = from[k];
  }
}

#if defined(__x86_64__)
/// run_batch() on one kind of register each. Only for processors that have it.
template <class Kernel>
[[gnu::target("avx512f,avx512dq,avx512vl")]] void run_avx512(const Kernel& kernel) {
  kernel(std::type_identity<Lanes8>{}, 0);
}
template <class Kernel>
[[gnu::target("avx2")]] void run_avx2(const Kernel& kernel) {
  for (int part = 0; part < kBatch; part += 4) kernel(std::type_identity<Lanes4>{}, part);
}
#endif
template <class Kernel>
void run_sse2(const Kernel& kernel) {
  for (int part = 0; part < kBatch; part += 2) kernel(std::type_identity<Lanes2>{}, part);
}

}  // namespace detail

/// Calls kernel(type_identity<Real>, part) until all eight lanes are done; part is the first lane of Real. The kernel
/// is a generic lambda marked always_inline, so that it is compiled for each kind of register.
template <class Kernel>
void run_batch(const Kernel& kernel) {
#if defined(__x86_64__)
  switch (vector_unit()) {
    case VectorUnit::Avx512:
      return detail::run_avx512(kernel);
    case VectorUnit::Avx2:
      return detail::run_avx2(kernel);
    case VectorUnit::Sse2:
      break;
  }
#endif
  detail::run_sse2(kernel);
}

#if defined(__x86_64__)
namespace detail {
/// run_for_processor() on one kind of register each. Only for processors that have it.
template <class Body>
[[gnu::target("avx512f,avx512dq,avx512vl")]] void run_with_64_bytes(const Body& body) {
  body(std::integral_constant<int, 64>{});
}
template <class Body>
[[gnu::target("avx2")]] void run_with_32_bytes(const Body& body) {
  body(std::integral_constant<int, 32>{});
}
}  // namespace detail
#endif

/// Calls body(integral_constant<int, kBytes>), a generic lambda marked always_inline, for registers of so many bytes.
template <class Body>
void run_for_processor(const Body& body) {
#if defined(__x86_64__)
  if (vector_unit() == VectorUnit::Avx512) return detail::run_with_64_bytes(body);
  if (vector_unit() == VectorUnit::Avx2) return detail::run_with_32_bytes(body);
#endif
  body(std::integral_constant<int, 16>{});
}

}  // namespace myotact::simulation
