#include "simulation/dense_front.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "simulation/element/batch.h"
#include "simulation/front_tiles.h"
#include "simulation/material/lanes.h"

namespace myotact::simulation {
namespace {

using tiles::UpdateColumns;

/// Four doubles side by side, anywhere in memory: one number of each of four right sides.
typedef double Pack __attribute__((vector_size(32), aligned(8), may_alias));

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

/// Eliminates the three columns from `start`, over all rows below; `scaled` receives their L D.
template <class Scalar>
MYOTACT_INLINE Pivots eliminate_node(const DenseFront<Scalar>& front, int start, Scalar* scaled) {
  Pivots pivots = Pivots::Positive;
  for (int c = start; c < start + 3; ++c) {
    Scalar* column = front.column(c);
    const Scalar pivot = column[c];
    if (!std::isfinite(pivot) || pivot == Scalar(0)) return Pivots::Unusable;
    if (pivot < Scalar(0)) pivots = Pivots::Mixed;
    Scalar* kept = scaled + static_cast<std::ptrdiff_t>(c - start) * front.stride;
    const Scalar inverse = Scalar(1) / pivot;
    for (int i = c + 1; i < front.size; ++i) {
      kept[i] = column[i];
      column[i] *= inverse;
    }
    std::fill_n(kept + front.size, kFrontPadding, Scalar(0));
    for (int k = c + 1; k < start + 3; ++k) {
      const Scalar factor = kept[k];
      Scalar* target = front.column(k);
      for (int i = k; i < front.size; ++i) target[i] -= column[i] * factor;
    }
  }
  return pivots;
}

template <class Scalar>
MYOTACT_INLINE Pivots eliminate(const DenseFront<Scalar>& front, UpdateColumns<Scalar> update_columns, Scalar* work) {
  Pivots pivots = Pivots::Positive;
  for (int start = 0; start < front.own; start += kFrontPanel) {
    const int end = std::min(start + kFrontPanel, front.own);
    for (int c = start; c < end; c += 3) {
      Scalar* scaled = work + static_cast<std::ptrdiff_t>(c - start) * front.stride;
      const Pivots here = eliminate_node(front, c, scaled);
      if (here == Pivots::Unusable) return here;
      if (here == Pivots::Mixed) pivots = here;
      update_columns(front, {c, 3, scaled}, c + 3, end);
    }
    update_columns(front, {start, end - start, work}, end, front.own);
    update_columns(front, {start, end - start, work}, front.own, front.size);
  }
  return pivots;
}

template <class Scalar>
MYOTACT_INLINE void forward(const DenseFront<Scalar>& front, double* values) {
  Pack* x = reinterpret_cast<Pack*>(values);
  for (int c = 0; c < front.own; c += 3) {
    const Scalar *first = front.column(c), *second = front.column(c + 1), *third = front.column(c + 2);
    x[c + 1] -= first[c + 1] * x[c];
    x[c + 2] = (x[c + 2] - first[c + 2] * x[c]) - second[c + 2] * x[c + 1];
    const Pack x0 = x[c], x1 = x[c + 1], x2 = x[c + 2];
    for (int i = c + 3; i < front.size; ++i) x[i] = ((x[i] - first[i] * x0) - second[i] * x1) - third[i] * x2;
  }
}

template <class Scalar>
MYOTACT_INLINE void backward(const DenseFront<Scalar>& front, double* values) {
  Pack* x = reinterpret_cast<Pack*>(values);
  for (int c = front.own - 3; c >= 0; c -= 3) {
    const Scalar *first = front.column(c), *second = front.column(c + 1), *third = front.column(c + 2);
    Pack sum[3] = {};
    for (int i = c + 3; i < front.size; ++i) {
      const Pack below = x[i];
      sum[0] += first[i] * below;
      sum[1] += second[i] * below;
      sum[2] += third[i] * below;
    }
    x[c + 2] = x[c + 2] / third[c + 2] - sum[2];
    x[c + 1] = (x[c + 1] / second[c + 1] - sum[1]) - second[c + 2] * x[c + 2];
    x[c] = ((x[c] / first[c] - sum[0]) - first[c + 1] * x[c + 1]) - first[c + 2] * x[c + 2];
  }
}

}  // namespace

template <class Scalar>
Pivots eliminate_front(const DenseFront<Scalar>& front, Scalar* work) {
  Pivots pivots = Pivots::Unusable;
  const UpdateColumns<Scalar> update_columns = update_columns_here<Scalar>();
  run_for_processor([&]() __attribute__((always_inline)) { pivots = eliminate(front, update_columns, work); });
  return pivots;
}

template <class Scalar>
void solve_forward(const DenseFront<Scalar>& front, double* values) {
  run_for_processor([&]() __attribute__((always_inline)) { forward(front, values); });
}

template <class Scalar>
void solve_backward(const DenseFront<Scalar>& front, double* values) {
  run_for_processor([&]() __attribute__((always_inline)) { backward(front, values); });
}

template Pivots eliminate_front(const DenseFront<float>&, float*);
template Pivots eliminate_front(const DenseFront<double>&, double*);
template void solve_forward(const DenseFront<float>&, double*);
template void solve_forward(const DenseFront<double>&, double*);
template void solve_backward(const DenseFront<float>&, double*);
template void solve_backward(const DenseFront<double>&, double*);

}  // namespace myotact::simulation
