#pragma once

#include <cmath>
#include <cstddef>

/// Put before everything that handles vector registers by value: compiled apart, for another processor than its caller,
/// it would expect them elsewhere.
#define MYOTACT_INLINE [[gnu::always_inline]] inline

// The laws and the elements' arithmetic are written once, for a `Real` that is a double or several of them side by
// side. Everything here works lane by lane with the same operations in the same order, so all give the same bits.

namespace myotact::simulation {

/// As many doubles as one register of SSE2, AVX2 and AVX-512 holds.
typedef double Lanes2 __attribute__((vector_size(16)));
typedef double Lanes4 __attribute__((vector_size(32)));
typedef double Lanes8 __attribute__((vector_size(64)));

/// Doubles in a Real.
template <class Real>
inline constexpr int kWidth = static_cast<int>(sizeof(Real) / sizeof(double));

/// The number in all lanes.
template <class Real>
MYOTACT_INLINE Real constant(double value) {
  return Real{} + value;
}

/// Function of one number, applied to each lane.
template <class Real, class Function>
MYOTACT_INLINE Real each(const Real& x, Function&& function) {
  if constexpr (kWidth<Real> == 1) {
    return function(x);
  } else {
    Real result{};
    for (int lane = 0; lane < kWidth<Real>; ++lane) result[lane] = function(x[lane]);
    return result;
  }
}

/// One lane, 0 .. kWidth - 1.
template <class Real>
MYOTACT_INLINE double lane_of(const Real& value, int lane) {
  if constexpr (kWidth<Real> == 1) {
    return value;
  } else {
    return value[lane];
  }
}

/// The larger of two numbers in each lane; b where one is NaN.
template <class Real>
MYOTACT_INLINE Real larger(const Real& a, const Real& b) {
  return a > b ? a : b;
}

/// a where x < y, else b (also where x or y is NaN).
template <class Real>
MYOTACT_INLINE Real where_less(const Real& x, const Real& y, const Real& a, const Real& b) {
  return x < y ? a : b;
}

/// Lane by lane; NaN below 0.
template <class Real>
MYOTACT_INLINE Real square_root(const Real& x) {
  return each(x, [](double v) { return __builtin_sqrt(v); });
}

/// Natural, lane by lane; -infinity at 0, NaN below.
template <class Real>
MYOTACT_INLINE Real logarithm(const Real& x) {
  return each(x, [](double v) { return std::log(v); });
}

}  // namespace myotact::simulation
