#include "simulation/linear/dense_front.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "simulation/linear/front_tiles.h"
#include "simulation/simd/batch.h"
#include "simulation/simd/lanes.h"

namespace myotact::simulation {
namespace {

using tiles::UpdateColumns;

/// Numbers side by side, anywhere in memory.
template <class Scalar, int kBytes>
struct VectorOf {
  static constexpr int kLanes = kBytes / static_cast<int>(sizeof(Scalar));
  using Bits = std::conditional_t<sizeof(Scalar) == 4, std::int32_t, std::int64_t>;
  typedef Scalar Type __attribute__((vector_size(kBytes), aligned(sizeof(Scalar)), may_alias));
  typedef Bits Mask __attribute__((vector_size(kBytes), aligned(sizeof(Scalar)), may_alias));

  /// A pointer, and no reference: clang takes what a function refers to as aligned like any vector of this size.
  MYOTACT_INLINE static const Type* at(const Scalar* from) { return reinterpret_cast<const Type*>(from); }
  MYOTACT_INLINE static void store(Scalar* to, const Type& value) { *reinterpret_cast<Type*>(to) = value; }
};

/// The version for this processor.
template <class Scalar>
UpdateColumns<Scalar> update_columns_here() {
#if defined(__x86_64__)
  constexpr bool kSingle = std::is_same_v<Scalar, float>;
  using Wide = std::conditional_t<kSingle, tiles::Avx512Float, tiles::Avx512Double>;
  using Narrow = std::conditional_t<kSingle, tiles::Avx2Float, tiles::Avx2Double>;
  switch (vector_unit()) {
    case VectorUnit::Avx512:
      return &tiles::avx512_columns<Wide, Scalar>;
    case VectorUnit::Avx2:
      return &tiles::avx2_columns<Narrow, Scalar>;
    case VectorUnit::Sse2:
      break;
  }
#endif
  return &tiles::plain_columns<tiles::Plain<Scalar>, Scalar>;
}

template <class Bits>
struct LeadingLanes {
  static constexpr std::array<Bits, 32> kMask = {-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};
};

/// to[0 .. count) += from[0 .. count). Reads and writes on to whole vectors; what lies behind stays as it is.
template <class Vector, class Scalar>
MYOTACT_INLINE void add_rows(Scalar* to, const Scalar* from, int count) {
  for (; count >= Vector::kLanes; count -= Vector::kLanes, to += Vector::kLanes, from += Vector::kLanes) {
    Vector::store(to, *Vector::at(to) + *Vector::at(from));
  }
  if (count == 0) return;
  using Mask = typename Vector::Mask;
  const auto& mask = LeadingLanes<typename Vector::Bits>::kMask;
  const Mask bits = *reinterpret_cast<const Mask*>(from) & *reinterpret_cast<const Mask*>(mask.data() + 16 - count);
  Vector::store(to, *Vector::at(to) + reinterpret_cast<const typename Vector::Type&>(bits));
}

/// Run by run, and not column by column: what is read back at once from where the last store ended would have to wait.
template <class Vector, class Scalar>
MYOTACT_INLINE void add_columns(const Scalar* remainder, std::span<const FrontRun> runs, const DenseFront<Scalar>& to) {
  int stride = kFrontPadding;
  for (const FrontRun& run : runs) stride += run.count;
  const Scalar* corner = remainder;  // where a run's rows meet its columns
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const FrontRun& columns = runs[r];
    for (int j = 0; j < columns.count; ++j) {
      const int first = columns.place + j;
      add_rows<Vector>(to.column(first) + first, corner + j * (stride + 1), columns.count - j);
    }
    const Scalar* from = corner + columns.count;
    for (std::size_t below = r + 1; below < runs.size(); ++below) {
      for (int j = 0; j < columns.count; ++j) {
        add_rows<Vector>(to.column(columns.place + j) + runs[below].place, from + j * stride, runs[below].count);
      }
      from += runs[below].count;
    }
    corner += columns.count * (stride + 1);
  }
}

template <class Scalar>
bool usable(Scalar pivot) {
  return std::isfinite(pivot) && pivot != Scalar(0);
}

/// Eliminates the three columns from c, over all rows below; `scaled` receives their L D.
template <class Vector, class Scalar>
MYOTACT_INLINE Pivots eliminate_node(const DenseFront<Scalar>& front, int c, Scalar* scaled) {
  const int stride = front.stride(c);
  Scalar *first = front.column(c), *second = first + stride, *third = second + stride;
  const Scalar d0 = first[c], k10 = first[c + 1], k20 = first[c + 2], inverse0 = Scalar(1) / d0;
  const Scalar l10 = k10 * inverse0, l20 = k20 * inverse0;
  const Scalar d1 = second[c + 1] - l10 * k10, k21 = second[c + 2] - l20 * k10, inverse1 = Scalar(1) / d1;
  const Scalar l21 = k21 * inverse1;
  const Scalar d2 = (third[c + 2] - l20 * k20) - l21 * k21, inverse2 = Scalar(1) / d2;
  if (!usable(d0) || !usable(d1) || !usable(d2)) return Pivots::Unusable;
  for (int i = c + 3; i < front.size; i += Vector::kLanes) {
    const auto x = *Vector::at(first + i);
    const auto l0 = x * inverse0;
    const auto y = *Vector::at(second + i) - l0 * k10;
    const auto l1 = y * inverse1;
    const auto z = (*Vector::at(third + i) - l0 * k20) - l1 * k21;
    Vector::store(scaled + i, x);
    Vector::store(scaled + stride + i, y);
    Vector::store(scaled + 2 * stride + i, z);
    Vector::store(first + i, l0);
    Vector::store(second + i, l1);
    Vector::store(third + i, z * inverse2);
  }
  for (int k = 0; k < 3; ++k) std::fill_n(scaled + k * stride + front.size, kFrontPadding, Scalar(0));
  first[c + 1] = l10;
  first[c + 2] = l20;
  second[c + 1] = d1;
  second[c + 2] = l21;
  third[c + 2] = d2;
  return d0 > Scalar(0) && d1 > Scalar(0) && d2 > Scalar(0) ? Pivots::Positive : Pivots::Mixed;
}

template <class Vector, class Scalar>
MYOTACT_INLINE Pivots eliminate(const DenseFront<Scalar>& front, UpdateColumns<Scalar> update_columns, Scalar* work) {
  Pivots pivots = Pivots::Positive;
  for (int start = 0; start < front.own; start += kFrontPanel) {
    const int end = std::min(start + kFrontPanel, front.own);
    for (int c = start; c < end; c += 3) {
      if (c > start) update_columns(front, {start, c - start, work}, c, c + 3);
      const Pivots here =
          eliminate_node<Vector>(front, c, work + static_cast<std::ptrdiff_t>(c - start) * front.stride(c));
      if (here == Pivots::Unusable) return here;
      if (here == Pivots::Mixed) pivots = here;
    }
    update_columns(front, {start, end - start, work}, end, front.own);
    update_columns(front, {start, end - start, work}, front.own, front.size);
  }
  return pivots;
}

template <class Vector, std::size_t kSides, class Scalar>
MYOTACT_INLINE void forward(const DenseFront<Scalar>& front, Scalar* values) {
  const int stride = front.stride(0), sides = front.size + kFrontPadding;
  for (int c = 0; c < front.own; c += 3) {
    const Scalar *first = front.column(c), *second = first + stride, *third = second + stride;
    std::array<std::array<Scalar, 3>, kSides> known;
    for (std::size_t r = 0; r < kSides; ++r) {
      Scalar* x = values + static_cast<std::ptrdiff_t>(r) * sides + c;
      x[1] -= first[c + 1] * x[0];
      x[2] = (x[2] - first[c + 2] * x[0]) - second[c + 2] * x[1];
      known[r] = {x[0], x[1], x[2]};
    }
    for (int i = c + 3; i < front.size; i += Vector::kLanes) {
      const auto l0 = *Vector::at(first + i), l1 = *Vector::at(second + i), l2 = *Vector::at(third + i);
      Scalar* x = values + i;
      for (std::size_t r = 0; r < kSides; ++r, x += sides) {
        Vector::store(x, ((*Vector::at(x) - l0 * known[r][0]) - l1 * known[r][1]) - l2 * known[r][2]);
      }
    }
  }
}

/// Sum of the lanes: halves upon each other until one is left. A pointer, as in at().
template <class Vector, class Scalar>
MYOTACT_INLINE Scalar sum_of(const typename Vector::Type* value) {
  if constexpr (Vector::kLanes == 2) {
    return (*value)[0] + (*value)[1];
  } else {
    using Half = VectorOf<Scalar, Vector::kLanes* static_cast<int>(sizeof(Scalar)) / 2>;
    const auto* halves = reinterpret_cast<const typename Half::Type*>(value);
    const typename Half::Type both = halves[0] + halves[1];
    return sum_of<Half, Scalar>(&both);
  }
}

template <class Vector, std::size_t kSides, class Scalar>
MYOTACT_INLINE void backward(const DenseFront<Scalar>& front, Scalar* values) {
  const int stride = front.stride(0), sides = front.size + kFrontPadding;
  for (int c = front.own - 3; c >= 0; c -= 3) {
    const Scalar *first = front.column(c), *second = first + stride, *third = second + stride;
    typename Vector::Type sum[kSides][3] = {};
    for (int i = c + 3; i < front.size; i += Vector::kLanes) {
      const auto l0 = *Vector::at(first + i), l1 = *Vector::at(second + i), l2 = *Vector::at(third + i);
      const Scalar* x = values + i;
      for (std::size_t r = 0; r < kSides; ++r, x += sides) {
        const auto below = *Vector::at(x);
        sum[r][0] += l0 * below;
        sum[r][1] += l1 * below;
        sum[r][2] += l2 * below;
      }
    }
    Scalar* x = values + c;
    for (std::size_t r = 0; r < kSides; ++r, x += sides) {
      x[2] = x[2] / third[c + 2] - sum_of<Vector, Scalar>(&sum[r][2]);
      x[1] = (x[1] / second[c + 1] - sum_of<Vector, Scalar>(&sum[r][1])) - second[c + 2] * x[2];
      x[0] = ((x[0] / first[c] - sum_of<Vector, Scalar>(&sum[r][0])) - first[c + 1] * x[1]) - first[c + 2] * x[2];
    }
  }
}

}  // namespace

template <class Scalar>
void zero_remainder(const DenseFront<Scalar>& front) {
  run_for_processor([&]<int kBytes>(std::integral_constant<int, kBytes>) __attribute__((always_inline)) {
    using Vector = VectorOf<Scalar, kBytes>;
    for (int c = front.own; c < front.size; ++c) {
      Scalar* column = front.column(c);
      for (int i = c; i < front.size; i += Vector::kLanes) Vector::store(column + i, typename Vector::Type{});
    }
  });
}

template <class Scalar>
void add_remainder(const Scalar* remainder, std::span<const FrontRun> runs, const DenseFront<Scalar>& to) {
  run_for_processor([&]<int kBytes>(std::integral_constant<int, kBytes>)
                        __attribute__((always_inline)) { add_columns<VectorOf<Scalar, kBytes>>(remainder, runs, to); });
}

template <class Scalar>
Pivots eliminate_front(const DenseFront<Scalar>& front, Scalar* work) {
  Pivots pivots = Pivots::Unusable;
  const UpdateColumns<Scalar> update_columns = update_columns_here<Scalar>();
  run_for_processor([&]<int kBytes>(std::integral_constant<int, kBytes>) __attribute__((always_inline)) {
    pivots = eliminate<VectorOf<Scalar, kBytes>>(front, update_columns, work);
  });
  return pivots;
}

template <std::size_t kSides, class Scalar>
void solve_forward(const DenseFront<Scalar>& front, Scalar* values) {
  run_for_processor([&]<int kBytes>(std::integral_constant<int, kBytes>)
                        __attribute__((always_inline)) { forward<VectorOf<Scalar, kBytes>, kSides>(front, values); });
}

template <std::size_t kSides, class Scalar>
void solve_backward(const DenseFront<Scalar>& front, Scalar* values) {
  run_for_processor([&]<int kBytes>(std::integral_constant<int, kBytes>)
                        __attribute__((always_inline)) { backward<VectorOf<Scalar, kBytes>, kSides>(front, values); });
}

template void zero_remainder(const DenseFront<float>&);
template void add_remainder(const float*, std::span<const FrontRun>, const DenseFront<float>&);
template Pivots eliminate_front(const DenseFront<float>&, float*);
template void solve_forward<1>(const DenseFront<float>&, float*);
template void solve_forward<kRightSides>(const DenseFront<float>&, float*);
template void solve_backward<1>(const DenseFront<float>&, float*);
template void solve_backward<kRightSides>(const DenseFront<float>&, float*);
template void zero_remainder(const DenseFront<double>&);
template void add_remainder(const double*, std::span<const FrontRun>, const DenseFront<double>&);
template Pivots eliminate_front(const DenseFront<double>&, double*);
template void solve_forward<1>(const DenseFront<double>&, double*);
template void solve_forward<kRightSides>(const DenseFront<double>&, double*);
template void solve_backward<1>(const DenseFront<double>&, double*);
template void solve_backward<kRightSides>(const DenseFront<double>&, double*);

}  // namespace myotact::simulation
