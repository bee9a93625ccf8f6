#include "simulation/curves/degroote_fregly.h"

#include <algorithm>
#include <cmath>

namespace myotact::simulation::degroote_fregly {
namespace {

constexpr double kPassiveShape = 4.0;
constexpr double kPassiveStrain = 0.6;   // at peak isometric force
constexpr double kPassiveZero_lo = 0.2;  // the curve passes 0 here
constexpr double kPassiveStraight_lo = 2.0;
constexpr double kLargestArgument = 1e300;  // the straight line stops growing, to stay finite

double passive_exponential(double n) noexcept {
  return std::exp(kPassiveShape * (n - 1.0) / kPassiveStrain);
}

double passive_scale() noexcept {
  static const double scale = 1.0 / (std::exp(kPassiveShape) - passive_exponential(kPassiveZero_lo));
  return scale;
}

}  // namespace

double passive_force_length(double n) noexcept {
  const double curved = std::min(n, kPassiveStraight_lo);
  const double straight = std::min(n, kLargestArgument) - curved;
  return (passive_exponential(curved) - passive_exponential(kPassiveZero_lo)) * passive_scale() +
         straight * passive_force_length_slope(kPassiveStraight_lo);
}

double passive_force_length_slope(double n) noexcept {
  return kPassiveShape / kPassiveStrain * passive_exponential(std::min(n, kPassiveStraight_lo)) * passive_scale();
}

}  // namespace myotact::simulation::degroote_fregly
