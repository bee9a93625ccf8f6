#include "simulation/dense_front.h"

#include <algorithm>
#include <cmath>

#include "simulation/element/batch.h"
#include "simulation/vector_clones.h"

namespace myotact::simulation {
namespace {

/// 32 bytes of numbers side by side, anywhere in memory.
template <class Scalar>
struct PackOf;
template <>
struct PackOf<float> {
  using Type = FloatPack;
};
template <>
struct PackOf<double> {
  using Type = Pack;
};

/// Columns [start, start + width), eliminated, with `scaled`: their L D, `stride` places a column.
template <class Scalar>
struct Eliminated {
  int start, width;
  const Scalar* scaled;
};

/// `Columns` columns from j of one pack of rows -= rows factors^T, held in registers. `to` and `rows` start at the
/// first row, `factors` at row j of L.
template <int Columns, class Scalar>
MYOTACT_INTO_CLONES void update_tile(const Eliminated<Scalar>& by, const Scalar* rows, const Scalar* factors,
                                     Scalar* to, std::ptrdiff_t stride) {
  using Pack = typename PackOf<Scalar>::Type;
  Pack sum[Columns] = {};
  for (int k = 0; k < by.width; ++k, rows += stride, factors += stride) {
    const Pack row = *reinterpret_cast<const Pack*>(rows);
    for (int c = 0; c < Columns; ++c) sum[c] += row * factors[c];
  }
  for (int c = 0; c < Columns; ++c) *reinterpret_cast<Pack*>(to + c * stride) -= sum[c];
}

template <int Columns, class Scalar>
MYOTACT_INTO_CLONES void update_strip(const DenseFront<Scalar>& front, const Eliminated<Scalar>& by, int j) {
  constexpr int kRows = static_cast<int>(sizeof(typename PackOf<Scalar>::Type) / sizeof(Scalar));
  const Scalar* factors = front.column(by.start) + j;
  for (int i = j; i < front.size; i += kRows) {
    update_tile<Columns>(by, by.scaled + i, factors, front.column(j) + i, front.stride);
  }
}

/// Columns [first, last) -= scaled L^T.
template <class Scalar>
MYOTACT_INTO_CLONES void update_columns(const DenseFront<Scalar>& front, const Eliminated<Scalar>& by, int first,
                                        int last) {
  int j = first;
  for (; j + 6 <= last; j += 6) update_strip<6>(front, by, j);
  if (j < last) update_strip<3>(front, by, j);
}

/// Eliminates the three columns from `start`, over all rows below; `scaled` receives their L D.
template <class Scalar>
MYOTACT_INTO_CLONES Pivots eliminate_node(const DenseFront<Scalar>& front, int start, Scalar* scaled) {
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
MYOTACT_INTO_CLONES Pivots eliminate(const DenseFront<Scalar>& front, Scalar* work) {
  Pivots pivots = Pivots::Positive;
  for (int start = 0; start < front.own; start += kFrontPanel) {
    const int end = std::min(start + kFrontPanel, front.own);
    for (int c = start; c < end; c += 3) {
      Scalar* scaled = work + static_cast<std::ptrdiff_t>(c - start) * front.stride;
      const Pivots here = eliminate_node(front, c, scaled);
      if (here == Pivots::Unusable) return here;
      if (here == Pivots::Mixed) pivots = here;
      update_columns<Scalar>(front, {c, 3, scaled}, c + 3, end);
    }
    update_columns<Scalar>(front, {start, end - start, work}, end, front.own);
    update_columns<Scalar>(front, {start, end - start, work}, front.own, front.size);
  }
  return pivots;
}

template <class Scalar>
MYOTACT_INTO_CLONES void forward(const DenseFront<Scalar>& front, double* values) {
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
MYOTACT_INTO_CLONES void backward(const DenseFront<Scalar>& front, double* values) {
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
  run_for_processor([&]() __attribute__((always_inline)) { pivots = eliminate(front, work); });
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
