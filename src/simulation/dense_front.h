#pragma once

#include <cstddef>

namespace myotact::simulation {

/// A dense symmetric matrix of which the lower triangle counts, column by column. The columns to eliminate lie apart
/// from the others: they are kept, the others are handed on. Each column is followed by at least kFrontPadding unused
/// places, so that loops may run over its end in whole vectors. Scalar is float or double.
template <class Scalar>
struct DenseFront {
  Scalar* own_values = nullptr;
  Scalar* rest_values = nullptr;  // of columns [own, size); nullptr for a front that is only solved with
  int stride = 0;                 // places from one column to the next, >= size + kFrontPadding
  int size = 0;                   // a multiple of 3
  int own = 0;                    // leading columns to eliminate, a multiple of 3

  Scalar* column(int c) const {
    return c < own ? own_values + static_cast<std::ptrdiff_t>(c) * stride
                   : rest_values + static_cast<std::ptrdiff_t>(c - own) * stride;
  }
};

inline constexpr int kFrontPadding = 16;
/// Columns that are eliminated together before the rest is updated: their part of a front of 150 rows stays in the
/// first-level cache. A multiple of 3.
inline constexpr int kFrontPanel = 24;

enum class Pivots { Positive, Mixed, Unusable };

/// Eliminates the own columns without pivoting: they become L (unit diagonal, D stored there), the rest the remainder
/// (Schur complement). `work` holds kFrontPanel columns of `stride`. Unusable when a pivot is zero or not finite.
template <class Scalar>
Pivots eliminate_front(const DenseFront<Scalar>& front, Scalar* work);

/// x[own] = L^-1 x[own] and x[below] -= L[below] x[own], gathered in the front's order: `values` holds 4 right sides
/// side by side, 4 size numbers.
template <class Scalar>
void solve_forward(const DenseFront<Scalar>& front, double* values);
/// x[own] = L^-T (D^-1 x[own] - L[below]^T x[below]). Between the two calls D^-1 has not been applied.
template <class Scalar>
void solve_backward(const DenseFront<Scalar>& front, double* values);

}  // namespace myotact::simulation
