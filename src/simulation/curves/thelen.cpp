#include "simulation/curves/thelen.h"

#include <algorithm>
#include <cmath>

namespace myotact::simulation::thelen {
namespace {

// Thelen 2003, table 1 (young adults), as OpenSim's Thelen2003Muscle has them.
constexpr double kActiveWidth = 0.45;    // gamma
constexpr double kPassiveStrain = 0.6;   // at peak isometric force
constexpr double kPassiveShape = 5.0;    // k_PE
constexpr double kHillShape = 0.25;      // A_f
constexpr double kLargestForce = 1.4;    // when lengthening
constexpr double kTendonStrain = 0.033;  // at peak isometric force
constexpr double kToeShape = 3.0;
constexpr double kToeForce = 0.33;

constexpr double kPassiveStraight_lo = 2.0;
/// The bell is 0 to the last bit far below this; keeps its slope from being 0 times infinity.
constexpr double kFarthest_lo = 1e3;
/// Straight lines stop growing here, so that the largest double stays finite.
constexpr double kLargestArgument = 1e300;

double passive_scale() noexcept {
  static const double scale = 1.0 / std::expm1(kPassiveShape);
  return scale;
}

/// Largest shortening speed at this activation, over that at full activation.
double speed_share(double activation) noexcept {
  return 0.25 + 0.75 * std::clamp(activation, 0.0, 1.0);
}

/// Speed of lengthening at which half of the gain above the isometric force is reached.
double half_gain_speed(double activation) noexcept {
  return speed_share(activation) * (kLargestForce - 1.0) / (1.0 + 1.0 / kHillShape);
}

/// Strain where the toe ends: chosen so that the straight part passes (kTendonStrain, 1) and meets the toe smoothly.
double toe_strain() noexcept {
  static const double growth = kToeShape * kToeForce * std::exp(kToeShape) / std::expm1(kToeShape);
  static const double strain = kTendonStrain * growth / (growth + 1.0 - kToeForce);
  return strain;
}

}  // namespace

double active_force_length(double n) noexcept {
  const double x = std::clamp(n, -kFarthest_lo, kFarthest_lo) - 1.0;
  return std::exp(-x * x / kActiveWidth);
}

double active_force_length_slope(double n) noexcept {
  const double x = std::clamp(n, -kFarthest_lo, kFarthest_lo) - 1.0;
  return -2.0 * x / kActiveWidth * std::exp(-x * x / kActiveWidth);
}

double passive_force_length(double n) noexcept {
  if (n <= 1.0) return 0.0;
  const double curved = std::min(n, kPassiveStraight_lo);
  const double straight = std::min(n, kLargestArgument) - curved;
  const double force = std::expm1(kPassiveShape * (curved - 1.0) / kPassiveStrain) * passive_scale();
  return force + straight * passive_force_length_slope(kPassiveStraight_lo);
}

double passive_force_length_slope(double n) noexcept {
  if (n <= 1.0) return 0.0;
  const double curved = std::min(n, kPassiveStraight_lo);
  return kPassiveShape / kPassiveStrain * std::exp(kPassiveShape * (curved - 1.0) / kPassiveStrain) * passive_scale();
}

double force_velocity(double v, double activation) noexcept {
  const double share = speed_share(activation);
  if (v <= -share) return 0.0;
  if (v <= 0.0) return (share + v) / (share - v / kHillShape);
  return 1.0 + (kLargestForce - 1.0) * (v / (v + half_gain_speed(activation)));
}

double force_velocity_slope(double v, double activation) noexcept {
  const double share = speed_share(activation);
  if (v <= -share) return 0.0;
  if (v <= 0.0) {
    const double below = share - v / kHillShape;
    return share * (1.0 + 1.0 / kHillShape) / (below * below);
  }
  const double half = half_gain_speed(activation);
  return (kLargestForce - 1.0) * half / ((v + half) * (v + half));
}

double velocity_at_force(double force, double activation) noexcept {
  const double share = speed_share(activation);
  if (force <= 0.0) return -share;
  if (force <= 1.0) return share * (force - 1.0) / (1.0 + force / kHillShape);
  const double half = half_gain_speed(activation);
  const double room = kLargestForce - force;
  return room <= half * (force - 1.0) ? 1.0 : half * (force - 1.0) / room;
}

double tendon_force(double stretch) noexcept {
  const double strain = std::min(stretch, kLargestArgument) - 1.0;
  if (strain <= 0.0) return 0.0;
  const double toe = toe_strain();
  if (strain <= toe) return kToeForce * std::expm1(kToeShape * strain / toe) / std::expm1(kToeShape);
  return kToeForce + (1.0 - kToeForce) * ((strain - toe) / (kTendonStrain - toe));
}

double tendon_force_slope(double stretch) noexcept {
  const double strain = stretch - 1.0;
  if (strain <= 0.0) return 0.0;
  const double toe = toe_strain();
  if (strain > toe) return (1.0 - kToeForce) / (kTendonStrain - toe);
  return kToeForce * kToeShape / toe * std::exp(kToeShape * strain / toe) / std::expm1(kToeShape);
}

}  // namespace myotact::simulation::thelen
