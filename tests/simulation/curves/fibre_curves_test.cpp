#include "simulation/curves/fibre_curves.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "simulation/curves/curve_set.h"

namespace myotact::simulation {
namespace {

// OpenSim 4's DeGrooteFregly2016Muscle evaluated at listed points, five decimals.
constexpr std::array<std::array<double, 3>, 11> kLengthTable = {{{0.5, 0.05411, 0.00057},
                                                                 {0.6, 0.30210, 0.00118},
                                                                 {0.7, 0.68423, 0.00239},
                                                                 {0.8, 0.83644, 0.00474},
                                                                 {0.9, 0.93712, 0.00932},
                                                                 {1.0, 1.00000, 0.01823},
                                                                 {1.1, 0.95316, 0.03559},
                                                                 {1.2, 0.79369, 0.06940},
                                                                 {1.3, 0.58119, 0.13526},
                                                                 {1.4, 0.38024, 0.26353},
                                                                 {1.5, 0.22615, 0.51337}}};
constexpr std::array<std::array<double, 2>, 10> kVelocityTable = {{{-1.0, 0.0},
                                                                   {-0.75, 0.09648},
                                                                   {-0.5, 0.23404},
                                                                   {-0.25, 0.47083},
                                                                   {-0.1, 0.74517},
                                                                   {0.0, 1.0},
                                                                   {0.1, 1.20651},
                                                                   {0.25, 1.40077},
                                                                   {0.5, 1.58842},
                                                                   {1.0, 1.79434}}};
constexpr double kTableDigits = 1e-5;

TEST(FibreCurves, ForceLengthMatchesThePublishedTable) {
  for (const auto& [n, active, passive] : kLengthTable) {
    EXPECT_NEAR(active_force_length(n), active, kTableDigits) << n;
    EXPECT_NEAR(force_curves(CurveSet::DeGrooteFregly2016).passive.value(n), passive, kTableDigits) << n;
    if (n <= 1.4) {
      EXPECT_NEAR(passive_force_length(n), passive, kTableDigits) << n;
    }
  }
}

TEST(FibreCurves, PassiveForceGoesOnAlongItsTangentPastTheLongestLivingFibre) {
  // The tangent at 1.4: the published 0.26353, and its derivative 4/0.6 (fP + fP0), fP0 what the curve is shifted by.
  const double shift = std::exp(-4.0 * 0.8 / 0.6) / (std::exp(4.0) - std::exp(-4.0 * 0.8 / 0.6));
  const double slope = 4.0 / 0.6 * (0.26353 + shift);
  for (const double n : {1.4, 1.5, 2.0, 5.0}) {
    EXPECT_NEAR(passive_force_length(n), 0.26353 + slope * (n - 1.4), 1e-4 * n) << n;
    EXPECT_NEAR(passive_force_length_slope(n), slope, 1e-4) << n;
  }
}

TEST(FibreCurves, ForceVelocityMatchesThePublishedTable) {
  for (const auto& [v, force] : kVelocityTable) EXPECT_NEAR(force_velocity(v), force, kTableDigits) << v;
}

TEST(FibreCurves, SlopesMatchThePublishedValues) {
  constexpr std::array<std::array<double, 2>, 5> kSlopes = {
      {{0.8, 1.03428}, {0.9, 0.95172}, {1.0, 0.16021}, {1.1, -1.09740}, {1.2, -1.98129}}};
  for (const auto& [n, slope] : kSlopes) EXPECT_NEAR(active_force_length_slope(n), slope, kTableDigits) << n;
  EXPECT_NEAR(passive_force_length_slope(1.0), 0.12212, kTableDigits);
  EXPECT_NEAR(force_velocity_slope(0.0), 2.45111, kTableDigits);
}

TEST(FibreCurves, SlopesAreTheDerivatives) {
  constexpr double h = 1e-6;
  for (double n = 0.05; n < 3.0; n += 0.0501) {
    const double active = (active_force_length(n + h) - active_force_length(n - h)) / (2.0 * h);
    const double passive = (passive_force_length(n + h) - passive_force_length(n - h)) / (2.0 * h);
    EXPECT_NEAR(active_force_length_slope(n), active, 1e-7) << n;
    EXPECT_NEAR(passive_force_length_slope(n), passive, 1e-6 * (1.0 + passive)) << n;
  }
  for (double v = -0.95; v < 2.0; v += 0.0501) {
    const double slope = (force_velocity(v + h) - force_velocity(v - h)) / (2.0 * h);
    EXPECT_NEAR(force_velocity_slope(v), slope, 1e-7) << v;
  }
}

TEST(FibreCurves, AreFiniteForAnyFiniteArgument) {
  for (const double x : {-1e300, -100.0, -2.5650, 0.0, 0.149473, 0.1494731, 100.0, 1e300}) {
    EXPECT_TRUE(std::isfinite(active_force_length(x)) && std::isfinite(active_force_length_slope(x))) << x;
    EXPECT_TRUE(std::isfinite(passive_force_length(x)) && std::isfinite(passive_force_length_slope(x))) << x;
    EXPECT_TRUE(std::isfinite(force_velocity(x)) && std::isfinite(force_velocity_slope(x))) << x;
  }
  EXPECT_EQ(force_velocity(-1.5), 0.0);
}

}  // namespace
}  // namespace myotact::simulation
