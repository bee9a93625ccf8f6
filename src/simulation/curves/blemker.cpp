#include "simulation/curves/blemker.h"

#include <algorithm>
#include <cmath>

namespace myotact::simulation::blemker {
namespace {

// Blemker et al. 2005, equations of the muscle's along-fibre stress.
constexpr double kShortest_lo = 0.4, kLongest_lo = 1.6;      // active force vanishes
constexpr double kRising_lo = 0.6, kFalling_lo = 1.4;        // the middle parabola ends
constexpr double kOuterCurvature = 9.0, kCurvature = 4.0;    // of the outer parabolas, of the middle one
constexpr double kPassiveScale = 0.05, kPassiveShape = 6.6;  // P1, P2
constexpr double kPassiveStraight_lo = 1.4;                  // lambda*
constexpr double kLargestArgument = 1e300;                   // the straight line stops growing, to stay finite

}  // namespace

double active_force_length(double n) noexcept {
  if (n <= kShortest_lo || n >= kLongest_lo) return 0.0;
  if (n <= kRising_lo) return kOuterCurvature * (n - kShortest_lo) * (n - kShortest_lo);
  if (n >= kFalling_lo) return kOuterCurvature * (n - kLongest_lo) * (n - kLongest_lo);
  return 1.0 - kCurvature * (1.0 - n) * (1.0 - n);
}

double active_force_length_slope(double n) noexcept {
  if (n <= kShortest_lo || n >= kLongest_lo) return 0.0;
  if (n <= kRising_lo) return 2.0 * kOuterCurvature * (n - kShortest_lo);
  if (n > kFalling_lo) return 2.0 * kOuterCurvature * (n - kLongest_lo);
  return 2.0 * kCurvature * (1.0 - n);
}

double passive_force_length(double n) noexcept {
  if (n <= 1.0) return 0.0;
  const double curved = std::min(n, kPassiveStraight_lo);
  const double straight = std::min(n, kLargestArgument) - curved;
  return kPassiveScale * std::expm1(kPassiveShape * (curved - 1.0)) +
         straight * passive_force_length_slope(kPassiveStraight_lo);
}

double passive_force_length_slope(double n) noexcept {
  if (n <= 1.0) return 0.0;
  const double curved = std::min(n, kPassiveStraight_lo);
  return kPassiveScale * kPassiveShape * std::exp(kPassiveShape * (curved - 1.0));
}

}  // namespace myotact::simulation::blemker
