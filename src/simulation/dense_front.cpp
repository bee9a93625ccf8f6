#include "simulation/dense_front.h"

#include <algorithm>
#include <cmath>

#include "simulation/vector_clones.h"

namespace myotact::simulation {

/// Eliminates columns [start, start + width) inside the panel of these columns, over all rows below. `scaled` receives
/// L D of the rows below the panel.
MYOTACT_VECTOR_CLONES
static Pivots eliminate_panel(const DenseFront& front, int start, int width, double* scaled) {
  Pivots pivots = Pivots::Positive;
  for (int c = start; c < start + width; ++c) {
    double* column = front.column(c);
    const double pivot = column[c];
    if (!std::isfinite(pivot) || pivot == 0.0) return Pivots::Unusable;
    if (pivot < 0.0) pivots = Pivots::Mixed;
    double* kept = scaled + static_cast<std::ptrdiff_t>(c - start) * front.stride;
    for (int i = c + 1; i < front.size; ++i) kept[i] = column[i];
    const double inverse = 1.0 / pivot;
    for (int i = c + 1; i < front.size; ++i) column[i] *= inverse;
    for (int k = c + 1; k < start + width; ++k) {
      const double factor = kept[k];
      double* target = front.column(k);
      for (int i = k; i < front.size; ++i) target[i] -= column[i] * factor;
    }
    for (int i = front.size; i < front.size + kFrontPadding; ++i) kept[i] = 0.0;
  }
  return pivots;
}

/// remainder -= scaled L^T for the columns after the panel: blocks of 8 rows and 3 columns, held in registers.
MYOTACT_VECTOR_CLONES
static void update_rest(const DenseFront& front, int start, int width, const double* scaled) {
  for (int j = start + width; j < front.size; j += 3) {
    double* to[3] = {front.column(j), front.column(j + 1), front.column(j + 2)};
    for (int i = j; i < front.size; i += 8) {
      Pack sum[3][2] = {};
      for (int k = 0; k < width; ++k) {
        const double* rows = scaled + static_cast<std::ptrdiff_t>(k) * front.stride + i;
        const Pack low = reinterpret_cast<const Pack*>(rows)[0], high = reinterpret_cast<const Pack*>(rows)[1];
        const double* factors = front.column(start + k) + j;
        for (int c = 0; c < 3; ++c) {
          sum[c][0] += low * factors[c];
          sum[c][1] += high * factors[c];
        }
      }
      for (int c = 0; c < 3; ++c) {
        reinterpret_cast<Pack*>(to[c] + i)[0] -= sum[c][0];
        reinterpret_cast<Pack*>(to[c] + i)[1] -= sum[c][1];
      }
    }
  }
}

Pivots eliminate_front(const DenseFront& front, double* work) {
  Pivots pivots = Pivots::Positive;
  for (int start = 0; start < front.own; start += kFrontPanel) {
    const int width = std::min(kFrontPanel, front.own - start);
    const Pivots here = eliminate_panel(front, start, width, work);
    if (here == Pivots::Unusable) return here;
    if (here == Pivots::Mixed) pivots = here;
    update_rest(front, start, width, work);
  }
  return pivots;
}

MYOTACT_VECTOR_CLONES
void solve_forward(const DenseFront& front, double* x) {
  for (int c = 0; c < front.own; ++c) {
    const double* column = front.column(c);
    const double factor = x[c];
    for (int i = c + 1; i < front.size; ++i) x[i] -= column[i] * factor;
  }
}

MYOTACT_VECTOR_CLONES
void solve_backward(const DenseFront& front, double* x) {
  for (int c = front.own - 1; c >= 0; --c) {
    const double* column = front.column(c);
    double sum = x[c] / column[c];
    Pack packed = {};  // partial sums in a fixed order, so that every processor adds alike
    int i = c + 1;
    for (; i + 4 <= front.size; i += 4) {
      packed += *reinterpret_cast<const Pack*>(column + i) * *reinterpret_cast<const Pack*>(x + i);
    }
    for (; i < front.size; ++i) sum -= column[i] * x[i];
    x[c] = sum - ((packed[0] + packed[1]) + (packed[2] + packed[3]));
  }
}

}  // namespace myotact::simulation
