#include "simulation/curves/millard.h"

#include <array>

#include "simulation/curves/piecewise_cubic.h"

namespace myotact::simulation::millard {
namespace {

// Defaults of OpenSim's ActiveForceLengthCurve, FiberForceLengthCurve, ForceVelocityCurve and TendonForceLengthCurve.
constexpr double kShortest_lo = 0.4441, kTransition_lo = 0.73, kLongest_lo = 1.8123;
constexpr double kShallowSlope = 0.8616;  // where the steep ascending limb ends
constexpr double kPassiveStrain = 0.7;    // at peak isometric force
constexpr double kPassiveLowSlope = 0.2, kPassiveSlope = 2.0 / kPassiveStrain;
constexpr double kPassiveFoot_lo = 0.1 / kPassiveSlope;  // over which the slope rises to the low one
constexpr double kIsometricSlope = 5.0;
constexpr double kLargestForce = 1.4;      // at the largest lengthening speed
constexpr double kNearLargestSpeed = 0.9;  // where the slopes near +-1 hold
constexpr double kShorteningSlope = 0.25, kLengtheningSlope = 0.15;
constexpr double kTendonStrain = 0.049;  // at peak isometric force
constexpr double kTendonSlope = 1.375 / kTendonStrain;
constexpr double kToeForce = 2.0 / 3.0;  // where the tendon's straight part begins

constexpr std::array<Knot, 4> kActive = {{{kShortest_lo, 0.0, 0.0},
                                          {kTransition_lo, 1.0 - kShallowSlope*(1.0 - kTransition_lo), kShallowSlope},
                                          {1.0, 1.0, 0.0},
                                          {kLongest_lo, 0.0, 0.0}}};

constexpr std::array<Knot, 3> kPassive = {
    {{1.0, 0.0, 0.0},
     {1.0 + kPassiveFoot_lo, 0.5 * kPassiveLowSlope* kPassiveFoot_lo, kPassiveLowSlope},
     {1.0 + kPassiveStrain, 1.0, kPassiveSlope}}};

constexpr Knot kIsometric = {0.0, 1.0, kIsometricSlope};
/// The parabola that ends with slope 0 at +-1 passes here.
constexpr double kNearRise = 0.5 * (1.0 - kNearLargestSpeed);
constexpr Knot kNearShortening = {-kNearLargestSpeed, kShorteningSlope* kNearRise, kShorteningSlope};
constexpr Knot kNearLengthening = {kNearLargestSpeed, kLargestForce - kLengtheningSlope* kNearRise, kLengtheningSlope};

constexpr std::array<Knot, 7> kVelocity = {{{-1.0, 0.0, 0.0},
                                            kNearShortening,
                                            smoothing_knot(kIsometric, kNearShortening),
                                            kIsometric,
                                            smoothing_knot(kIsometric, kNearLengthening),
                                            kNearLengthening,
                                            {1.0, kLargestForce, 0.0}}};

constexpr std::array<Knot, 3> kTendon = {
    {{1.0, 0.0, 0.0},
     {1.0 + kTendonStrain - (1.0 - kToeForce) / kTendonSlope, kToeForce, kTendonSlope},
     {1.0 + kTendonStrain, 1.0, kTendonSlope}}};

}  // namespace

double active_force_length(double n) noexcept {
  return curve_value(kActive, n);
}
double active_force_length_slope(double n) noexcept {
  return curve_slope(kActive, n);
}

double passive_force_length(double n) noexcept {
  return curve_value(kPassive, n);
}
double passive_force_length_slope(double n) noexcept {
  return curve_slope(kPassive, n);
}

double force_velocity(double v) noexcept {
  return curve_value(kVelocity, v);
}
double force_velocity_slope(double v) noexcept {
  return curve_slope(kVelocity, v);
}

double velocity_at_force(double force) noexcept {
  constexpr int kHalvings = 53;  // as many as a double has digits
  double slower = -1.0, faster = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (slower + faster);
    (force_velocity(middle) < force ? slower : faster) = middle;
  }
  return 0.5 * (slower + faster);
}

double tendon_force(double stretch) noexcept {
  return curve_value(kTendon, stretch);
}
double tendon_force_slope(double stretch) noexcept {
  return curve_slope(kTendon, stretch);
}

}  // namespace myotact::simulation::millard
