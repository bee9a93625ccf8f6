#include "simulation/curves/curve_set.h"

#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "simulation/curves/fibre_curves.h"

namespace myotact::simulation {
namespace {

constexpr std::array<CurveSet, 4> kAllSets = {CurveSet::DeGrooteFregly2016, CurveSet::Thelen2003, CurveSet::Millard2012,
                                              CurveSet::Blemker2005};
/// The tables' closed forms have five decimals.
constexpr double kTableDigits = 1e-5;
/// Samples of a curve, interpolated between neighbours 0.005 apart (0.002 for the tendon).
constexpr double kSampleTolerance = 2e-3;

const ForceCurves& thelen_curves() {
  return force_curves(CurveSet::Thelen2003);
}
const ForceCurves& millard_curves() {
  return force_curves(CurveSet::Millard2012);
}
const ForceCurves& blemker_curves() {
  return force_curves(CurveSet::Blemker2005);
}

struct LengthRow {
  double n, thelen_active, blemker_active, millard_active, thelen_passive, blemker_passive, millard_passive;
};

constexpr std::array<LengthRow, 11> kLengthTable = {{{0.5, 0.57375, 0.09, 0.0690, 0, 0, 0},
                                                     {0.6, 0.70078, 0.36, 0.4024, 0, 0, 0},
                                                     {0.7, 0.81873, 0.64, 0.7230, 0, 0, 0},
                                                     {0.8, 0.91495, 0.84, 0.8393, 0, 0, 0},
                                                     {0.9, 0.97802, 0.96, 0.9480, 0, 0, 0},
                                                     {1.0, 1, 1, 1, 0, 0, 0},
                                                     {1.1, 0.97802, 0.96, 0.9582, 0.00883, 0.04674, 0.0244},
                                                     {1.2, 0.91495, 0.84, 0.8480, 0.02913, 0.13717, 0.0878},
                                                     {1.3, 0.81873, 0.64, 0.6915, 0.07586, 0.31214, 0.1898},
                                                     {1.4, 0.70078, 0.36, 0.5114, 0.18337, 0.65066, 0.3312},
                                                     {1.5, 0.57375, 0.09, 0.3298, 0.43076, 1.11310, 0.5128}}};

TEST(CurveSet, LengthCurvesMatchThePublishedTables) {
  for (const LengthRow& row : kLengthTable) {
    EXPECT_NEAR(thelen_curves().active.value(row.n), row.thelen_active, kTableDigits) << row.n;
    EXPECT_NEAR(blemker_curves().active.value(row.n), row.blemker_active, kTableDigits) << row.n;
    EXPECT_NEAR(millard_curves().active.value(row.n), row.millard_active, kSampleTolerance) << row.n;
    EXPECT_NEAR(thelen_curves().passive.value(row.n), row.thelen_passive, kTableDigits) << row.n;
    EXPECT_NEAR(blemker_curves().passive.value(row.n), row.blemker_passive, kTableDigits) << row.n;
    EXPECT_NEAR(millard_curves().passive.value(row.n), row.millard_passive, kSampleTolerance) << row.n;
  }
}

TEST(CurveSet, VelocityCurvesMatchThePublishedTables) {
  constexpr std::array<std::array<double, 3>, 10> kTable = {{{-1, 0, 0},
                                                             {-0.75, 0.0523, 0.0625},
                                                             {-0.5, 0.1477, 0.1667},
                                                             {-0.25, 0.3282, 0.3750},
                                                             {-0.1, 0.6101, 0.6429},
                                                             {0, 1, 1},
                                                             {0.1, 1.2038, 1.2222},
                                                             {0.25, 1.2579, 1.3030},
                                                             {0.5, 1.3235, 1.3448},
                                                             {1, 1.4, 1.3704}}};
  constexpr double kFourDigits = 5e-5;
  for (const auto& [v, millard, thelen] : kTable) {
    EXPECT_NEAR(millard_curves().velocity.value(v, 1.0), millard, kSampleTolerance) << v;
    EXPECT_NEAR(thelen_curves().velocity.value(v, 1.0), thelen, kFourDigits) << v;
  }
}

TEST(CurveSet, TendonCurvesMatchThePublishedTables) {
  constexpr std::array<std::array<double, 3>, 4> kTable = {
      {{0.01, 0.08829, 0.0644}, {0.02, 0.21557, 0.2329}, {0.033, 0.46848, 0.5525}, {0.049, 1, 1}}};
  for (const auto& [strain, de_groote, millard] : kTable) {
    EXPECT_NEAR(tendon_force(1.0 + strain), de_groote, kTableDigits) << strain;
    EXPECT_NEAR(millard_curves().tendon.value(1.0 + strain), millard, kSampleTolerance) << strain;
  }
  EXPECT_NEAR(thelen_curves().tendon.value(1.033), 1.0, kTableDigits);
}

double central_difference(const Curve& curve, double x) {
  constexpr double h = 1e-6;
  return (curve.value(x + h) - curve.value(x - h)) / (2.0 * h);
}

/// Where a curve has a kink, or curvature so jumps that a central difference across it is off.
bool near_a_joint(double x) {
  for (const double joint : {0.4, 0.4441, 0.6, 0.73, 1.0, 1.4, 1.6, 1.7, 1.8123}) {
    if (std::abs(x - joint) < 1e-5) return true;
  }
  return false;
}

TEST(CurveSet, SlopesAreTheDerivatives) {
  for (const CurveSet set : kAllSets) {
    const ForceCurves& curves = force_curves(set);
    for (double n = 0.05; n < 3.0; n += 0.0101) {
      if (near_a_joint(n)) continue;
      EXPECT_NEAR(curves.active.slope(n), central_difference(curves.active, n), 1e-6) << n;
      const double passive = curves.passive.slope(n);
      EXPECT_NEAR(passive, central_difference(curves.passive, n), 1e-6 * (1.0 + passive)) << n;
    }
    for (double strain = -0.0203; strain < 0.15; strain += 0.00101) {
      const double slope = curves.tendon.slope(1.0 + strain);
      EXPECT_NEAR(slope, central_difference(curves.tendon, 1.0 + strain), 1e-6 * (1.0 + slope)) << strain;
    }
  }
}

TEST(CurveSet, VelocitySlopesAreTheDerivativesAtAnyActivation) {
  constexpr double h = 1e-6;
  for (const CurveSet set : kAllSets) {
    const VelocityCurve& curve = force_curves(set).velocity;
    for (const double a : {0.0, 0.3, 1.0}) {
      for (double v = -1.4951; v < 2.0; v += 0.0101) {
        if (std::abs(v + 0.25 + 0.75 * a) < 1e-5) continue;  // Thelen's curve ends with a kink
        const double slope = (curve.value(v + h, a) - curve.value(v - h, a)) / (2.0 * h);
        EXPECT_NEAR(curve.slope(v, a), slope, 1e-6 * (1.0 + slope)) << v << " at " << a;
      }
    }
  }
}

TEST(CurveSet, CurvesAreContinuousAndTheirSlopesToo) {
  constexpr double kAcross = 1e-9;
  const auto jump = [](double (*f)(double) noexcept, double x) { return std::abs(f(x + kAcross) - f(x - kAcross)); };
  for (const CurveSet set : kAllSets) {
    const ForceCurves& curves = force_curves(set);
    for (double x = 0.0; x < 2.5; x += 1e-4) {
      EXPECT_LT(jump(curves.active.value, x), 1e-7) << x;
      EXPECT_LT(jump(curves.passive.value, x), 1e-6) << x;
      EXPECT_LT(jump(curves.tendon.value, x), 1e-6) << x;
      // Thelen's and Blemker's passive fibre and Thelen's tendon are published with a kink where they go slack.
      if (std::abs(x - 1.0) > 1e-6) {
        EXPECT_LT(jump(curves.passive.slope, x), 1e-5) << x;
        EXPECT_LT(jump(curves.tendon.slope, x), 1e-4) << x;
      }
      // Blemker's parabolas meet at 0.6 and 1.4 with slopes of 3.6 and 3.2.
      if (!near_a_joint(x)) {
        EXPECT_LT(jump(curves.active.slope, x), 1e-6) << x;
      }
    }
    for (double v = -0.9999; v < 2.0; v += 1e-4) {
      const auto& velocity = curves.velocity;
      EXPECT_NEAR(velocity.value(v + kAcross, 1.0), velocity.value(v - kAcross, 1.0), 1e-7) << v;
      EXPECT_NEAR(velocity.slope(v + kAcross, 1.0), velocity.slope(v - kAcross, 1.0), 1e-6) << v;
    }
  }
}

TEST(CurveSet, InverseGivesTheVelocityBack) {
  for (const CurveSet set : kAllSets) {
    const VelocityCurve& curve = force_curves(set).velocity;
    for (const double a : {0.2, 1.0}) {
      for (double v = -0.36; v < 0.99; v += 0.05) {
        EXPECT_NEAR(curve.inverse(curve.value(v, a), a), v, 1e-9) << v << " at " << a;
      }
    }
    EXPECT_NEAR(curve.inverse(1e9, 1.0), 1.0, 1e-12);
    EXPECT_NEAR(curve.inverse(-1e9, 1.0), -1.0, 1e-12);
  }
}

TEST(CurveSet, ThelenShortensMoreSlowlyWhenLessActive) {
  const VelocityCurve& curve = thelen_curves().velocity;
  EXPECT_EQ(curve.inverse(0.0, 1.0), -1.0);
  EXPECT_EQ(curve.inverse(0.0, 0.0), -0.25);
  EXPECT_EQ(curve.value(-0.25, 0.0), 0.0);
  EXPECT_NEAR(curve.value(-0.3125, 0.5), 0.5 / 3.0, 1e-15);  // half of its largest speed
}

TEST(CurveSet, EverythingIsFiniteForAnyFiniteArgument) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  for (const CurveSet set : kAllSets) {
    const ForceCurves& curves = force_curves(set);
    for (const double x : {-kLargest, -1e300, -100.0, 0.0, 5e-324, 100.0, 1e300, kLargest}) {
      for (const Curve& curve : {curves.active, curves.passive, curves.tendon}) {
        EXPECT_TRUE(std::isfinite(curve.value(x)) && std::isfinite(curve.slope(x))) << x;
      }
      for (const double a : {0.0, 1.0, x}) {
        EXPECT_TRUE(std::isfinite(curves.velocity.value(x, a)) && std::isfinite(curves.velocity.slope(x, a))) << x;
        EXPECT_TRUE(std::isfinite(curves.velocity.inverse(x, a))) << x;
      }
    }
  }
}

TEST(CurveSet, IsFoundByName) {
  EXPECT_EQ(find_curve_set("millard_2012"), CurveSet::Millard2012);
  EXPECT_EQ(find_curve_set("millard"), std::nullopt);
  ASSERT_EQ(curve_set_names().size(), kAllSets.size());
  for (const CurveSet set : kAllSets) {
    EXPECT_EQ(find_curve_set(curve_set_names()[static_cast<std::size_t>(set)]), set);
  }
  EXPECT_EQ(force_curves(CurveSet::DeGrooteFregly2016).active.value(0.9), active_force_length(0.9));
}

}  // namespace
}  // namespace myotact::simulation
