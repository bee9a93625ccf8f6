#include "measure/stiffness_band.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "measure/hinge_scene.h"
#include "simulation/line/line_model.h"

namespace myotact::measure {
namespace {

using ::testing::HasSubstr;

constexpr double kCommon = 0.4;
constexpr double kAngle_rad = 0.15;

/// What the band varies, one number each.
struct Variant {
  Vec3 centre_m = Vec3::Zero();
  Vec3 axis = -Vec3::UnitY();
  double flexor_force = 1.0;
  double rest_stretch_m = 0.0;  // added
};

/// A straight line from a fixed to a turning point by nothing but geometry: length, and its slopes by differences.
struct StraightLine {
  double length_m, slope_m_rad, curvature_m_rad2, elongation_m;
};

StraightLine straight_line(const anatomy::MuscleLine& line, const Variant& variant, double q_rad) {
  const auto length_m = [&](double q) {
    const Vec3 turned =
        variant.centre_m + Eigen::AngleAxisd(q, variant.axis) * Vec3(line.points.back().position_m - variant.centre_m);
    return (turned - line.points.front().position_m).norm();
  };
  const double h = 1e-4;  // truncation and rounding of the second difference both near 1e-8 m
  const double below = length_m(q_rad - h), here = length_m(q_rad), above = length_m(q_rad + h);
  return {here, (above - below) / (2.0 * h), (above - 2.0 * here + below) / (h * h), here - length_m(0.0)};
}

/// K of the two bars, the flexor weaker: it works at kCommon, the extensor cancels its torque.
double stiffness_of(const LineLimb& limb, const Variant& variant) {
  anatomy::Muscle flexor = limb.specimen.muscles[0], extensor = limb.specimen.muscles[1];
  flexor.peak_force_N *= variant.flexor_force;
  flexor.rest_stretch += variant.rest_stretch_m;
  extensor.rest_stretch += variant.rest_stretch_m;
  const StraightLine f = straight_line(limb.specimen.lines[0], variant, kAngle_rad);
  const StraightLine e = straight_line(limb.specimen.lines[1], variant, kAngle_rad);
  const auto force = [](const anatomy::Muscle& muscle, const StraightLine& line, double activation) {
    return simulation::line_force(muscle, line.elongation_m, 0.0, activation);
  };
  const auto torque = [&](const anatomy::Muscle& muscle, const StraightLine& line, double activation) {
    return -line.slope_m_rad * force(muscle, line, activation).force_N;
  };
  const bool flexor_weaker = std::abs(torque(flexor, f, 1.0)) < std::abs(torque(extensor, e, 1.0));
  const auto& weak = flexor_weaker ? flexor : extensor;
  const auto& weak_line = flexor_weaker ? f : e;
  const auto& strong = flexor_weaker ? extensor : flexor;
  const auto& strong_line = flexor_weaker ? e : f;
  const double asked = -torque(weak, weak_line, kCommon) - torque(strong, strong_line, 0.0);
  const double level = asked / (torque(strong, strong_line, 1.0) - torque(strong, strong_line, 0.0));
  double sum = 0.0;
  for (const bool first : {true, false}) {
    const auto pull = first ? force(weak, weak_line, kCommon) : force(strong, strong_line, level);
    const StraightLine& line = first ? weak_line : strong_line;
    sum += line.slope_m_rad * line.slope_m_rad * pull.stiffness_N_m + line.curvature_m_rad2 * pull.force_N;
  }
  return sum;
}

/// Root of the sum of squares of the changes, from independently varied bars.
BandPart expected(const LineLimb& limb, const std::vector<std::pair<Variant, Variant>>& ways) {
  const double plain = stiffness_of(limb, {});
  BandPart part;
  for (const auto& [below, above] : ways) {
    const double a = stiffness_of(limb, below) - plain, b = stiffness_of(limb, above) - plain;
    part.up_Nm_rad += std::pow(std::max({0.0, a, b}), 2);
    part.down_Nm_rad += std::pow(std::max({0.0, -a, -b}), 2);
  }
  return {"", std::sqrt(part.down_Nm_rad), std::sqrt(part.up_Nm_rad)};
}

LineLimb uncertain_limb() {
  LineLimb limb = line_limb(testing::hinge_scene());
  limb.specimen.joints[0].centre_uncertainty_m = 0.003;
  limb.specimen.joints[0].axis_uncertainty_rad = 0.17;
  return limb;
}

void expect_part(const BandPart& part, const std::string& cause, const BandPart& wanted) {
  EXPECT_EQ(part.cause, cause);
  const double size = wanted.down_Nm_rad + wanted.up_Nm_rad;
  EXPECT_GT(size, 0.0) << cause;
  const double differences = 1e-5 * size;  // of the second differences above
  EXPECT_NEAR(part.down_Nm_rad, wanted.down_Nm_rad, differences) << cause;
  EXPECT_NEAR(part.up_Nm_rad, wanted.up_Nm_rad, differences) << cause;
}

TEST(StiffnessBand, EachCauseIsWhatBarsPutOffByItGive) {
  const LineLimb limb = uncertain_limb();
  const std::vector<double> angles = {kAngle_rad};
  const auto parts = stiffness_band(limb, angles, kCommon);
  ASSERT_EQ(parts.size(), 4u);
  // The two directions across the axis span a plane; any pair of them is as good, the code's choice is repeated here.
  const Vec3 axis = limb.specimen.joints[0].axes[0];
  const std::vector<Vec3> across = {axis.unitOrthogonal(), axis.cross(axis.unitOrthogonal())};
  const auto both_ways = [](const std::function<Variant(double)>& at) { return std::pair{at(-1.0), at(1.0)}; };
  std::vector<std::pair<Variant, Variant>> moved, tilted;
  for (const Vec3& direction : across) {
    moved.push_back(both_ways([&](double sign) { return Variant{sign * 0.003 * direction}; }));
    tilted.push_back(both_ways([&](double sign) {
      return Variant{Vec3::Zero(), Eigen::AngleAxisd(sign * 0.17, direction) * axis};
    }));
  }
  expect_part(parts[0], "joint centre", expected(limb, moved));
  expect_part(parts[1], "joint axis", expected(limb, tilted));
  expect_part(parts[2], "peak force", expected(limb, {both_ways([&](double sign) {
                                                 return Variant{Vec3::Zero(), axis, 1.0 + sign * kPeakForceUncertainty};
                                               })}));
  expect_part(parts[3], "rest stretch",
              expected(limb, {both_ways([&](double sign) {
                         return Variant{Vec3::Zero(), axis, 1.0, sign * kRestStretchUncertainty};
                       })}));
}

TEST(StiffnessBand, BalancedLinesAreTheClosedForm) {
  const LineLimb limb = uncertain_limb();
  const std::vector<double> angles = {kAngle_rad};
  const double K = stiffness_of(limb, {});
  EXPECT_NEAR(balanced_line_stiffness_Nm_rad(limb, angles, kCommon), K, 1e-5 * std::abs(K));
}

TEST(StiffnessBand, AddsUpAsTheRootOfTheSumOfSquaresEachWay) {
  const BandPart whole = whole_band({{"a", 3.0, 0.0}, {"b", 4.0, 2.0}});
  EXPECT_DOUBLE_EQ(whole.down_Nm_rad, 5.0);
  EXPECT_DOUBLE_EQ(whole.up_Nm_rad, 2.0);
}

TEST(StiffnessBand, LeavesOutWhatTheSpecimenIsSureOfAndSaysSo) {
  LineLimb limb = uncertain_limb();
  anatomy::Joint& joint = limb.specimen.joints[0];
  EXPECT_EQ(missing_uncertainty(joint), "");
  joint.axis_uncertainty_rad = 0.0;
  EXPECT_THAT(missing_uncertainty(joint), HasSubstr("axis_uncertainty_rad of the joint elbow"));
  const std::vector<double> angles = {kAngle_rad};
  auto parts = stiffness_band(limb, angles, kCommon);
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_EQ(parts[0].cause, "joint centre");
  joint.centre_uncertainty_m = 0.0;
  EXPECT_THAT(missing_uncertainty(joint), HasSubstr("centre_uncertainty_m, axis_uncertainty_rad"));
  parts = stiffness_band(limb, angles, kCommon);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].cause, "peak force");
}

TEST(StiffnessBand, WeightOfAHangingRodIsAPendulums) {
  LineLimb limb = uncertain_limb();
  const anatomy::Body& rod = limb.specimen.bodies[1];
  const double moment_arm_m = (rod.com_m - limb.specimen.joints[0].centre_m).norm();
  const Vec3 down = (rod.com_m - limb.specimen.joints[0].centre_m) / moment_arm_m;
  const std::vector<double> angles = {0.3};
  EXPECT_NEAR(weight_stiffness_Nm_rad(limb, angles, 9.81 * down), rod.mass_kg * 9.81 * moment_arm_m * std::cos(0.3),
              1e-12);
}

}  // namespace
}  // namespace myotact::measure
