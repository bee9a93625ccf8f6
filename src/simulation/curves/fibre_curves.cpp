#include "simulation/curves/fibre_curves.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "simulation/curves/degroote_fregly.h"

namespace myotact::simulation {
namespace {

/// height exp(-((n - centre) / width)^2 / 2) with width = width0 + width1 n.
struct Bell {
  double height, centre, width0, width1;
};

constexpr std::array<Bell, 3> kBells = {{
    {0.8150671134243542, 1.055033428970575, 0.162384573599574, 0.063303448465465},
    {0.433004984392647, 0.716775413397760, -0.029947116970696, 0.200356847296188},
    {0.1, 1.0, 0.353553390593274, 0.0},
}};

/// Curves that rise for ever stop here, so that the largest double stays finite.
constexpr double kLargestArgument = 1e300;

/// A bell is below 1e-300 when its argument exceeds this; leaving it out there keeps 0/0 away where its width passes 0.
constexpr double kFarthestDeviation = 37.0;

/// Beyond this the passive curve is a straight line; Blemker, Pinsky and Delp (2005) set it here.
constexpr double kPassiveStraight_lo = 1.4;

constexpr std::array<double, 4> kVelocity = {-0.3211346127989808, -8.149, -0.374, 0.8825327733249912};

constexpr double kTendonStrain = 0.049;  // at peak isometric force
constexpr double kTendonScale = 0.2;     // c1; the tendon pushes with no more than this
constexpr double kTendonStraight = 1.0 + 2.0 * kTendonStrain;

/// Exponent per unit of strain that makes the force 1 at kTendonStrain.
double tendon_shape() noexcept {
  static const double shape = std::log((1.0 + kTendonScale) / kTendonScale) / kTendonStrain;
  return shape;
}

/// (n - centre) / width, or nothing to add (false) where the bell has vanished.
bool deviation(const Bell& bell, double n, double& x) noexcept {
  const double width = bell.width0 + bell.width1 * n;
  if (!(std::abs(n - bell.centre) < kFarthestDeviation * std::abs(width))) return false;
  x = (n - bell.centre) / width;
  return true;
}

}  // namespace

double active_force_length(double n) noexcept {
  double sum = 0.0;
  double x = 0.0;
  for (const Bell& bell : kBells) {
    if (deviation(bell, n, x)) sum += bell.height * std::exp(-0.5 * x * x);
  }
  return sum;
}

double active_force_length_slope(double n) noexcept {
  double sum = 0.0;
  double x = 0.0;
  for (const Bell& bell : kBells) {
    if (!deviation(bell, n, x)) continue;
    const double width = bell.width0 + bell.width1 * n;
    const double dx_dn = (1.0 - x * bell.width1) / width;
    sum -= bell.height * std::exp(-0.5 * x * x) * x * dx_dn;
  }
  return sum;
}

double passive_force_length(double n) noexcept {
  const double curved = std::min(n, kPassiveStraight_lo);
  const double straight = std::min(n, kLargestArgument) - curved;
  return degroote_fregly::passive_force_length(curved) + straight * passive_force_length_slope(kPassiveStraight_lo);
}

double passive_force_length_slope(double n) noexcept {
  return degroote_fregly::passive_force_length_slope(std::min(n, kPassiveStraight_lo));
}

double force_velocity(double v) noexcept {
  if (v <= -1.0) return 0.0;
  const double force =
      kVelocity[0] * std::asinh(kVelocity[1] * std::min(v, kLargestArgument) + kVelocity[2]) + kVelocity[3];
  return force > 0.0 ? force : 0.0;
}

double force_velocity_slope(double v) noexcept {
  if (v <= -1.0) return 0.0;
  const double argument = kVelocity[1] * v + kVelocity[2];
  return kVelocity[0] * kVelocity[1] / std::sqrt(argument * argument + 1.0);
}

double velocity_at_force(double force) noexcept {
  if (force <= 0.0) return -1.0;
  const double bounded = std::min(force, force_velocity(1.0));  // sinh overflows not far beyond
  const double v = (std::sinh((bounded - kVelocity[3]) / kVelocity[0]) - kVelocity[2]) / kVelocity[1];
  return std::clamp(v, -1.0, 1.0);
}

double tendon_force(double stretch) noexcept {
  const double curved = std::min(stretch, kTendonStraight);
  const double straight = std::min(stretch, kLargestArgument) - curved;
  return kTendonScale * std::expm1(tendon_shape() * (curved - 1.0)) + straight * tendon_force_slope(kTendonStraight);
}

double tendon_force_slope(double stretch) noexcept {
  const double curved = std::min(stretch, kTendonStraight);
  return kTendonScale * tendon_shape() * std::exp(tendon_shape() * (curved - 1.0));
}

double tendon_strain_at(double force) noexcept {
  return std::log1p(force / kTendonScale) / tendon_shape();
}

}  // namespace myotact::simulation
