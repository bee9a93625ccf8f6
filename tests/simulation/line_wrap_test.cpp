#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "simulation/line/line_model.h"
#include "simulation/line/line_segment.h"
#include "support/allocation_guard.h"

// Muscle lines round surfaces that ride on bodies: closed forms, central differences, what is drawn.

namespace myotact::simulation {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

using anatomy::LinePointKind;
using anatomy::LineWrap;
using geometry::WrapShape;

anatomy::Joint hinge(int parent, int child, const Vec3& centre_m, const Vec3& axis) {
  anatomy::Joint joint;
  joint.key = "hinge_" + std::to_string(child);
  joint.parent = parent;
  joint.child = child;
  joint.centre_m = centre_m;
  joint.axes = {axis.normalized()};
  joint.range_rad = {{-2.0, 2.0}};
  return joint;
}

/// One hinge about z through the origin.
anatomy::Specimen single_hinge() {
  anatomy::Specimen specimen;
  specimen.bodies.resize(2);
  specimen.joints = {hinge(0, 1, Vec3::Zero(), Vec3::UnitZ())};
  return specimen;
}

LineGeometry measured(const anatomy::MuscleLine& line, Skeleton& skeleton, std::span<const double> angles_rad) {
  skeleton.set_pose(angles_rad);
  LineGeometry geometry;
  measure_line(line, skeleton, geometry);
  return geometry;
}

/// A path over one joint: planar radii a, b of its ends and the angle between them on the muscle's side, axial offset,
/// cylinder about the axis; sense +1: flexion opens that angle. Millimetres and degrees.
struct PlanarPath {
  const char* muscle;
  double a, b, phi0_deg, dz, radius;
  int sense;
  double demo_q_deg, r, dr_dq;
};

// Canine elbow, stifle and hock: radii, angles and, to the digits given, moment arm and its slope at the pose of the
// demonstration (elbow and hock at the file pose, stifle flexed by 20 degrees).
constexpr std::array<PlanarPath, 18> kPaths = {{
    {"biceps brachii", 30, 30, 142.5259, -1.822, 11.351, -1, 0, 11.35, 0.00},
    {"brachialis", 30, 30, 138.5211, -10.836, 11.351, -1, 0, 11.15, -0.08},
    {"triceps long", 80, 32.305, 60.7548, -2.833, 11.351, 1, 0, -32.13, -3.28},
    {"triceps lateral", 80, 24.633, 91.5978, -6.459, 11.351, 1, 0, -23.28, 7.06},
    {"triceps medial", 80, 25.474, 97.5463, 6.136, 11.351, 1, 0, -23.14, 9.20},
    {"triceps accessory", 80, 30.919, 64.8592, -4.834, 11.351, 1, 0, -30.82, -1.39},
    {"anconeus", 30, 18.702, 86.5380, 2.846, 11.351, 1, 0, -16.23, 6.66},
    {"biceps femoris", 80, 40, 106.7924, 35.002, 15.790, -1, 20, 33.93, 10.32},
    {"semitendinosus", 80, 40, 112.5534, 24.945, 15.790, -1, 20, 33.87, 13.67},
    {"gracilis", 80, 40, 137.0755, 42.635, 15.790, -1, 20, 25.25, 18.56},
    {"rectus femoris", 60, 43.321, 153.4478, 16.937, 21.370, 1, 20, -21.12, -0.09},
    {"vastus lateralis", 60, 43.321, 160.5021, 12.022, 21.370, 1, 20, -21.25, -0.05},
    {"vastus medialis", 60, 43.321, 160.3667, 27.228, 21.370, 1, 20, -20.77, -0.22},
    {"vastus intermedius", 60, 43.321, 159.0967, 15.381, 21.370, 1, 20, -21.17, -0.07},
    {"cranial tibial", 20, 20, 110.8670, -2.052, 9.214, -1, 0, 11.33, 8.20},
    {"long digital extensor", 20, 20, 99.4754, -2.314, 9.214, -1, 0, 12.89, 7.58},
    {"gastrocnemius", 80, 36.368, 48.2962, 4.482, 9.214, 1, 0, -34.91, -11.52},
    {"superficial flexor", 80, 36.132, 55.4170, 2.390, 9.214, 1, 0, -35.76, -5.44},
}};

anatomy::MuscleLine line_of(const PlanarPath& path) {
  const double angle = path.sense * path.phi0_deg * kDegree;
  anatomy::MuscleLine line;
  line.points = {
      {0, Vec3(path.a, 0.0, 0.0) * 1e-3, LinePointKind::Origin},
      {1, Vec3(path.b * std::cos(angle), path.b * std::sin(angle), path.dz) * 1e-3, LinePointKind::Insertion}};
  LineWrap wrap;
  wrap.body = 0;
  wrap.radii_m.setConstant(path.radius * 1e-3);
  wrap.side = Vec3(std::cos(0.5 * angle), std::sin(0.5 * angle), 0.0);
  line.wraps = {wrap};
  return line;
}

TEST(LineWrap, MomentArmsOfTheCanineMusclesAreThoseOfTheClosedForm) {
  Skeleton skeleton(single_hinge());
  for (const PlanarPath& path : kPaths) {
    const LineGeometry geometry = measured(line_of(path), skeleton, std::array{path.demo_q_deg * kDegree});
    EXPECT_NEAR(-1e3 * geometry.slope_m_rad[0], path.r, 0.0051) << path.muscle;  // two digits are published
    EXPECT_NEAR(-1e3 * geometry.curvature_m_rad2(0, 0), path.dr_dq, 0.0051) << path.muscle;
    EXPECT_EQ(geometry.stuck_wrap, -1) << path.muscle;
  }
}

TEST(LineWrap, APulleyAboutTheAxisHasAConstantArm) {
  PlanarPath path = kPaths[0];
  path.dz = 0.0;
  Skeleton skeleton(single_hinge());
  for (int body = 0; body < 2; ++body) {  // it does not matter on which side of the joint the cylinder rides
    anatomy::MuscleLine line = line_of(path);
    line.wraps[0].body = body;
    for (const double q_deg : {-12.0, -5.0, 0.0, 5.0}) {
      const LineGeometry geometry = measured(line, skeleton, std::array{q_deg * kDegree});
      EXPECT_NEAR(-geometry.slope_m_rad[0], 11.351e-3, 1e-15) << q_deg;
      EXPECT_NEAR(geometry.curvature_m_rad2(0, 0), 0.0, 1e-15) << q_deg;
    }
  }
}

TEST(LineWrap, LengthIsContinuousThroughLiftOffAndBeyondTheStraightLine) {
  Skeleton skeleton(single_hinge());
  for (const PlanarPath& path : kPaths) {
    const anatomy::MuscleLine line = line_of(path);
    constexpr double step = 0.01 * kDegree;
    LineGeometry before = measured(line, skeleton, std::array{-25.0 * kDegree});
    for (double q = -25.0 * kDegree; q < 95.0 * kDegree; q += step) {
      const LineGeometry now = measured(line, skeleton, std::array{q});
      EXPECT_LT(std::abs(now.length_m - before.length_m), 0.05 * step + 1e-9) << path.muscle;
      const double steepest_m = std::max(now.curvature_m_rad2.norm(), before.curvature_m_rad2.norm());
      EXPECT_LT(std::abs(now.slope_m_rad[0] - before.slope_m_rad[0]), 1.01 * steepest_m * step + 1e-9) << path.muscle;
      before = now;
    }
  }
}

// ---- several joints

/// Three skew hinges in a row; the line goes from the first body to the last, its surface rides on one between.
struct Chain {
  anatomy::Specimen specimen;
  anatomy::MuscleLine line;
};

Chain chain(WrapShape shape, int surface_body) {
  Chain c;
  c.specimen.bodies.resize(4);
  c.specimen.joints = {hinge(0, 1, Vec3(0.01, 0.005, 0.06), Vec3(0.1, 1.0, 0.2)),
                       hinge(1, 2, Vec3(-0.004, 0.01, 0.02), Vec3(-0.2, 0.9, 0.3)),
                       hinge(2, 3, Vec3(0.0, 0.0, -0.03), Vec3(0.3, 1.0, -0.1))};
  c.line.points = {{0, Vec3(0.012, 0.002, 0.1), LinePointKind::Origin},
                   {1, Vec3(0.008, 0.004, 0.05), LinePointKind::Via},
                   {3, Vec3(0.009, -0.003, -0.05), LinePointKind::Insertion}};
  LineWrap wrap;
  wrap.body = surface_body;
  wrap.after = 1;
  wrap.shape = shape;
  wrap.centre_m = Vec3(0.001, 0.002, 0.001);
  wrap.side = Vec3(1.0, 0.1, -0.05).normalized();
  wrap.radii_m.setConstant(0.014);
  if (shape == WrapShape::Ellipsoid) wrap.radii_m = Vec3(0.013, 0.022, 0.017);
  wrap.axes = Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  if (shape == WrapShape::Cylinder) {
    const Vec3 axis = Vec3(0.1, 1.0, 0.15).normalized();
    wrap.axes.row(2) = axis.transpose();
    wrap.axes.row(0) = axis.unitOrthogonal().transpose();
    wrap.axes.row(1) = axis.cross(axis.unitOrthogonal()).transpose();
  }
  c.line.wraps = {wrap};
  return c;
}

class WrapOf : public ::testing::TestWithParam<WrapShape> {};
INSTANTIATE_TEST_SUITE_P(LineWrap, WrapOf,
                         ::testing::Values(WrapShape::Cylinder, WrapShape::Sphere, WrapShape::Ellipsoid));

TEST_P(WrapOf, ArmsAndTheirSlopesMatchDifferencesOverThreeJoints) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> angle(-0.45, 0.45);
  constexpr double h = 1e-5;
  int wrapped = 0;
  for (int body = 0; body < 4; ++body) {
    const Chain c = chain(GetParam(), body);
    Skeleton skeleton(c.specimen);
    for (int pose = 0; pose < 30; ++pose) {
      const std::array<double, 3> q{angle(random), angle(random), angle(random)};
      const LineGeometry here = measured(c.line, skeleton, q);
      const LineStop from{1, skeleton.body_pose(1) * c.line.points[1].position_m};
      const LineStop to{3, skeleton.body_pose(3) * c.line.points[2].position_m};
      wrapped +=
          measure_segment(skeleton, from, to, &c.line.wraps[0]).length_m > (to.p_W - from.p_W).norm() * (1.0 + 1e-6);
      for (std::size_t j = 0; j < 3; ++j) {
        std::array<double, 3> up = q, down = q;
        up[j] += h;
        down[j] -= h;
        const LineGeometry ahead = measured(c.line, skeleton, up), behind = measured(c.line, skeleton, down);
        const double size_m = 0.02;  // of a moment arm
        EXPECT_NEAR(here.slope_m_rad[static_cast<int>(j)], (ahead.length_m - behind.length_m) / (2 * h), 1e-6 * size_m);
        const Eigen::VectorXd slope = (ahead.slope_m_rad - behind.slope_m_rad) / (2 * h);
        const double most = 1e-6 * (size_m + slope.norm());
        EXPECT_LT((here.curvature_m_rad2.col(static_cast<int>(j)) - slope).norm(), most) << "pose " << pose;
      }
    }
  }
  EXPECT_GT(wrapped, 60);
}

TEST_P(WrapOf, WhatIsDrawnHasTheLinesLengthAndAlwaysAsManyPoints) {
  const Chain c = chain(GetParam(), 2);
  Skeleton skeleton(c.specimen);
  for (double q = -0.9; q < 0.9; q += 0.1) {
    const LineGeometry geometry = measured(c.line, skeleton, std::array{0.3 * q, q, -0.4 * q});
    const std::vector<Vec3> points = line_points_W(c.line, skeleton);
    ASSERT_EQ(points.size(), 3u + kWrapPoints);
    EXPECT_EQ(points[1], skeleton.body_pose(1) * c.line.points[1].position_m);
    double length_m = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) length_m += (points[i] - points[i - 1]).norm();
    EXPECT_LT(length_m, geometry.length_m * (1.0 + 1e-9));
    EXPECT_GT(length_m, geometry.length_m * 0.998);
  }
  skeleton.set_pose(std::array{0.0, 0.0, 0.0});
  EXPECT_EQ(line_points_W(c.line, skeleton), line_points_L(c.line));
}

TEST_P(WrapOf, ALineThatCannotClearSaysSo) {
  Chain c = chain(GetParam(), 2);
  Skeleton skeleton(c.specimen);
  EXPECT_EQ(measured(c.line, skeleton, std::array{0.0, 0.0, 0.0}).stuck_wrap, -1);
  c.line.points[1].position_m = c.line.wraps[0].centre_m;
  const LineGeometry stuck = measured(c.line, skeleton, std::array{0.0, 0.1, 0.0});
  EXPECT_EQ(stuck.stuck_wrap, 0);
  EXPECT_TRUE(std::isfinite(stuck.length_m) && stuck.slope_m_rad.allFinite() && stuck.curvature_m_rad2.allFinite());
}

TEST_P(WrapOf, MeasuringAgainAllocatesNothing) {
  const Chain c = chain(GetParam(), 2);
  const Skeleton skeleton(c.specimen);
  LineGeometry geometry;
  measure_line(c.line, skeleton, geometry);
  const support::AllocationGuard guard;
  measure_line(c.line, skeleton, geometry);
  EXPECT_EQ(guard.allocations(), 0u);
}

TEST(LineWrap, SeveralSurfacesOnOneLine) {
  Chain c = chain(WrapShape::Cylinder, 2);
  LineWrap second = c.line.wraps[0];
  second.body = 1;
  second.after = 0;
  second.shape = WrapShape::Sphere;
  second.centre_m = Vec3(0.0, 0.003, 0.075);
  second.radii_m.setConstant(0.012);
  c.line.wraps.push_back(second);
  Skeleton skeleton(c.specimen);
  constexpr double h = 1e-5;
  const LineGeometry here = measured(c.line, skeleton, std::array{0.1, 0.2, -0.1});
  const LineGeometry up = measured(c.line, skeleton, std::array{0.1 + h, 0.2, -0.1});
  const LineGeometry down = measured(c.line, skeleton, std::array{0.1 - h, 0.2, -0.1});
  EXPECT_NEAR(here.slope_m_rad[0], (up.length_m - down.length_m) / (2 * h), 1e-9);
  EXPECT_LT((here.curvature_m_rad2.col(0) - (up.slope_m_rad - down.slope_m_rad) / (2 * h)).norm(), 1e-8);
  EXPECT_EQ(line_points_W(c.line, skeleton).size(), 3u + 2 * kWrapPoints);
}

}  // namespace
}  // namespace myotact::simulation
