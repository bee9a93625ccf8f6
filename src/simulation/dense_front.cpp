#include "simulation/dense_front.h"

#include <algorithm>
#include <cmath>

#include "simulation/vector_clones.h"

namespace myotact::simulation {
namespace {

/// Columns [start, start + width), eliminated, with `scaled`: their L D, `stride` places a column.
struct Eliminated {
  int start, width;
  const float* scaled;
};

/// `Columns` columns from j of 8 rows -= rows factors^T, held in registers. `to` and `rows` start at the first row,
/// `factors` at row j of L.
template <int Columns>
MYOTACT_INTO_CLONES void update_tile(const Eliminated& by, const float* rows, const float* factors, float* to,
                                     std::ptrdiff_t stride) {
  FloatPack sum[Columns] = {};
  for (int k = 0; k < by.width; ++k, rows += stride, factors += stride) {
    const FloatPack row = *reinterpret_cast<const FloatPack*>(rows);
    for (int c = 0; c < Columns; ++c) sum[c] += row * factors[c];
  }
  for (int c = 0; c < Columns; ++c) *reinterpret_cast<FloatPack*>(to + c * stride) -= sum[c];
}

template <int Columns>
MYOTACT_INTO_CLONES void update_strip(const DenseFront& front, const Eliminated& by, int j) {
  const float* factors = front.column(by.start) + j;
  for (int i = j; i < front.size; i += 8) {
    update_tile<Columns>(by, by.scaled + i, factors, front.column(j) + i, front.stride);
  }
}

/// Columns [first, last) -= scaled L^T.
MYOTACT_INTO_CLONES void update_columns(const DenseFront& front, const Eliminated& by, int first, int last) {
  int j = first;
  for (; j + 6 <= last; j += 6) update_strip<6>(front, by, j);
  if (j < last) update_strip<3>(front, by, j);
}

/// Eliminates the three columns from `start`, over all rows below; `scaled` receives their L D.
MYOTACT_INTO_CLONES Pivots eliminate_node(const DenseFront& front, int start, float* scaled) {
  Pivots pivots = Pivots::Positive;
  for (int c = start; c < start + 3; ++c) {
    float* column = front.column(c);
    const float pivot = column[c];
    if (!std::isfinite(pivot) || pivot == 0.0F) return Pivots::Unusable;
    if (pivot < 0.0F) pivots = Pivots::Mixed;
    float* kept = scaled + static_cast<std::ptrdiff_t>(c - start) * front.stride;
    const float inverse = 1.0F / pivot;
    for (int i = c + 1; i < front.size; ++i) {
      kept[i] = column[i];
      column[i] *= inverse;
    }
    std::fill_n(kept + front.size, kFrontPadding, 0.0F);
    for (int k = c + 1; k < start + 3; ++k) {
      const float factor = kept[k];
      float* target = front.column(k);
      for (int i = k; i < front.size; ++i) target[i] -= column[i] * factor;
    }
  }
  return pivots;
}

}  // namespace

MYOTACT_VECTOR_CLONES
Pivots eliminate_front(const DenseFront& front, float* work) {
  Pivots pivots = Pivots::Positive;
  for (int start = 0; start < front.own; start += kFrontPanel) {
    const int end = std::min(start + kFrontPanel, front.own);
    for (int c = start; c < end; c += 3) {
      float* scaled = work + static_cast<std::ptrdiff_t>(c - start) * front.stride;
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

MYOTACT_VECTOR_CLONES
void solve_forward(const DenseFront& front, double* values) {
  Pack* x = reinterpret_cast<Pack*>(values);
  for (int c = 0; c < front.own; c += 3) {
    const float *first = front.column(c), *second = front.column(c + 1), *third = front.column(c + 2);
    x[c + 1] -= first[c + 1] * x[c];
    x[c + 2] = (x[c + 2] - first[c + 2] * x[c]) - second[c + 2] * x[c + 1];
    const Pack x0 = x[c], x1 = x[c + 1], x2 = x[c + 2];
    for (int i = c + 3; i < front.size; ++i) x[i] = ((x[i] - first[i] * x0) - second[i] * x1) - third[i] * x2;
  }
}

MYOTACT_VECTOR_CLONES
void solve_backward(const DenseFront& front, double* values) {
  Pack* x = reinterpret_cast<Pack*>(values);
  for (int c = front.own - 3; c >= 0; c -= 3) {
    const float *first = front.column(c), *second = front.column(c + 1), *third = front.column(c + 2);
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

}  // namespace myotact::simulation
