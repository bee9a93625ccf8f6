#pragma once

#include <cstddef>
#include <span>

namespace myotact::simulation {

/// Places that each column of a front is followed by.
inline constexpr int kFrontPadding = 16;

/// A dense symmetric matrix of which the lower triangle counts, column by column. The columns to eliminate lie apart
/// from the others: they are kept, the others are handed on, and of these only the rows from `own` on are stored. Each
/// column is followed by kFrontPadding places that hold zero at the start, so that loops may run over its end in whole
/// vectors. Scalar is float or double.
template <class Scalar>
struct DenseFront {
  Scalar* own_values = nullptr;   // of columns [0, own)
  Scalar* rest_values = nullptr;  // of columns [own, size); nullptr for a front that is only solved with
  int size = 0;                   // a multiple of 3
  int own = 0;                    // leading columns to eliminate, a multiple of 3

  /// Places from a column to the next one on the same side of `own`.
  int stride(int c) const { return (c < own ? size : size - own) + kFrontPadding; }
  /// Where row 0 of a column is, or would be.
  Scalar* column(int c) const {
    return c < own ? own_values + static_cast<std::ptrdiff_t>(c) * stride(c)
                   : rest_values + static_cast<std::ptrdiff_t>(c - own) * stride(c) - own;
  }
};

/// Columns that are eliminated together before the rest is updated: their part of a front of 150 rows stays in the
/// first-level cache. A multiple of 3.
inline constexpr int kFrontPanel = 24;

/// Neighbouring columns, and rows, of a front that are neighbours in another one too.
struct FrontRun {
  int count = 0;  // multiples of 3, both
  int place = 0;  // of the first one in the other front
};

/// Signs of the pivots of a factorisation. Unusable: one was zero or not finite.
enum class Pivots { Positive, Mixed, Unusable };

/// Zeroes the lower triangle of the columns [own, size).
template <class Scalar>
void zero_remainder(const DenseFront<Scalar>& front);

/// Adds a remainder, the columns [own, size) of a front as eliminate_front() leaves them, to the lower triangle of
/// `to`. The runs say where its columns go, in their order.
template <class Scalar>
void add_remainder(const Scalar* remainder, std::span<const FrontRun> runs, const DenseFront<Scalar>& to);

/// Eliminates the own columns without pivoting: they become L (unit diagonal, D stored there), the rest the remainder
/// (Schur complement). `work` holds kFrontPanel columns as long as the own ones. Unusable when a pivot is zero or not
/// finite.
template <class Scalar>
Pivots eliminate_front(const DenseFront<Scalar>& front, Scalar* work);

/// Right sides that are solved at once, for the factor is read once for all of them.
inline constexpr std::size_t kRightSides = 4;

/// x[own] = L^-1 x[own] and x[below] -= L[below] x[own], gathered in the front's order: `values` holds kSides columns
/// of `size` numbers, each followed by kFrontPadding zeros. kSides is 1 or kRightSides; a column's bits do not depend
/// on it.
template <std::size_t kSides, class Scalar>
void solve_forward(const DenseFront<Scalar>& front, Scalar* values);
/// x[own] = L^-T (D^-1 x[own] - L[below]^T x[below]). Between the two calls D^-1 has not been applied.
template <std::size_t kSides, class Scalar>
void solve_backward(const DenseFront<Scalar>& front, Scalar* values);

}  // namespace myotact::simulation
