#include "simulation/skeleton/skeleton.h"

#include <cmath>
#include <string>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "core/error.h"
#include "simulation/skeleton/skeleton_loads.h"

namespace myotact::simulation {
namespace {

constexpr double kGravity_m_s2 = 9.81;

anatomy::Body make_body(const std::string& key, double mass_kg, const Vec3& com_m) {
  return {key, mass_kg, com_m, {2e-4, 3e-4, 4e-4, 1e-5, -2e-5, 3e-5}, false};
}

anatomy::Joint make_hinge(const std::string& key, int parent, int child, const Vec3& centre_m, const Vec3& axis) {
  anatomy::Joint joint;
  joint.key = key;
  joint.parent = parent;
  joint.child = child;
  joint.centre_m = centre_m;
  joint.axes = {axis.normalized()};
  joint.range_rad = {{-3.0, 3.0}};
  return joint;
}

/// trunk (0) - shoulder - arm (1) - elbow - forearm (2) - weld - paw (3), listed against the order of the tree.
anatomy::Specimen arm() {
  anatomy::Specimen specimen;
  specimen.bodies = {make_body("trunk", 5.0, {0, 0, 0}), make_body("arm", 0.4, {0.02, 0.01, -0.08}),
                     make_body("forearm", 0.3, {0.03, 0.0, -0.25}), make_body("paw", 0.1, {0.05, -0.01, -0.4})};
  anatomy::Joint weld = make_hinge("wrist", 2, 3, {0.05, 0, -0.35}, {0, 1, 0});
  weld.type = anatomy::JointType::Weld;
  specimen.joints = {weld, make_hinge("elbow", 1, 2, {0.04, 0, -0.16}, {0.1, -1, 0.2}),
                     make_hinge("shoulder", 0, 1, {0, 0, 0}, {0.3, -1, -0.1})};
  return specimen;
}

constexpr int kWrist = 0, kElbow = 1, kShoulder = 2, kPaw = 3;

TEST(Skeleton, BodiesTurnAboutTheirJointsInTheWorld) {
  Skeleton skeleton(arm());
  const Vec3 p_L(0.06, 0.0, -0.42);
  EXPECT_LT((skeleton.body_pose(kPaw) * p_L - p_L).norm(), 1e-15);
  skeleton.set_pose(std::vector<double>{0.7, 0.5, -0.3});  // the weld's angle is ignored
  const anatomy::Specimen model = arm();
  const auto turn = [&](int j, double q, const Vec3& p) -> Vec3 {
    const anatomy::Joint& joint = model.joints[static_cast<std::size_t>(j)];
    return Eigen::AngleAxisd(q, joint.axes[0]) * (p - joint.centre_m) + joint.centre_m;
  };
  const Vec3 expected = turn(kShoulder, -0.3, turn(kElbow, 0.5, p_L));
  EXPECT_LT((skeleton.body_pose(kPaw) * p_L - expected).norm(), 1e-14);
  EXPECT_EQ(skeleton.angle_rad(kWrist), 0.0);
}

TEST(Skeleton, PointDerivativesMatchDifferences) {
  Skeleton skeleton(arm());
  const std::vector<double> q{0.0, 0.5, -0.3};
  const Vec3 p_L(0.06, 0.02, -0.42);
  constexpr double h = 1e-5;
  const auto at_angles = [&](int j, double dq) {
    std::vector<double> moved = q;
    moved[static_cast<std::size_t>(j)] += dq;
    skeleton.set_pose(moved);
    return Vec3(skeleton.body_pose(kPaw) * p_L);
  };
  for (const int j : {kElbow, kShoulder}) {
    for (const int k : {kElbow, kShoulder}) {
      const Vec3 ahead = skeleton.point_derivative(kPaw, k, at_angles(j, h));
      const Vec3 behind = skeleton.point_derivative(kPaw, k, at_angles(j, -h));
      const Vec3 here = at_angles(j, 0.0);
      const Vec3 second = skeleton.point_second_derivative(kPaw, j, k, here);
      EXPECT_LT((second - (ahead - behind) / (2 * h)).norm(), 1e-9) << j << k;
    }
    const Vec3 slope = (at_angles(j, h) - at_angles(j, -h)) / (2 * h);
    EXPECT_LT((skeleton.point_derivative(kPaw, j, at_angles(j, 0.0)) - slope).norm(), 1e-9);
  }
  EXPECT_EQ(skeleton.point_derivative(1, kElbow, p_L), Vec3(Vec3::Zero()));
}

TEST(Skeleton, InertiaIsTheParallelAxisSumAndTheMassMatrixDiagonal) {
  anatomy::Specimen specimen = arm();
  specimen.joints[kElbow].axes = {Vec3(0, -1, 0)};
  Skeleton skeleton(specimen);
  // Forearm and paw about the y axis through (0.04, ., -0.16): Iyy + m d^2.
  const double expected = 3e-4 + 0.3 * (0.01 * 0.01 + 0.09 * 0.09) + 3e-4 + 0.1 * (0.01 * 0.01 + 0.24 * 0.24);
  EXPECT_NEAR(skeleton.inertia_kg_m2(kElbow), expected, 1e-15);
  SkeletonLoads loads;
  const std::vector<double> zeros(3, 0.0);
  loads.compute(skeleton, {Vec3::Zero(), zeros, zeros});
  EXPECT_NEAR(loads.mass_kg_m2(kElbow, kElbow), expected, 1e-15);
  EXPECT_NEAR(loads.mass_kg_m2(kElbow, kShoulder), loads.mass_kg_m2(kShoulder, kElbow), 1e-16);
}

TEST(Skeleton, AFreeArmKeepsItsEnergy) {
  Skeleton skeleton(arm());
  SkeletonLoads loads;
  const std::vector<double> torque(3, 0.0);
  const Vec3 gravity(0, 0, -kGravity_m_s2);
  Eigen::Vector3d q(0.0, 0.6, 0.9), v(0.0, 2.0, -1.0);
  const auto spans = [](const Eigen::Vector3d& x) { return std::span<const double>(x.data(), 3); };
  const auto acceleration = [&](const Eigen::Vector3d& angles, const Eigen::Vector3d& speeds) {
    skeleton.set_pose(spans(angles));
    loads.compute(skeleton, {gravity, spans(speeds), torque});
    Eigen::Vector3d a = Eigen::Vector3d::Zero();
    a.tail<2>() = loads.mass_kg_m2.bottomRightCorner<2, 2>().inverse() * loads.force_Nm.tail<2>();
    return a;
  };
  const auto energy = [&] {
    acceleration(q, v);
    double sum = 0.5 * v.tail<2>().dot(loads.mass_kg_m2.bottomRightCorner<2, 2>() * v.tail<2>());
    for (int b = 0; b < 4; ++b) sum -= skeleton.body(b).mass_kg * gravity.dot(skeleton.com_W(b));
    return sum;
  };
  const double before = energy();
  constexpr double h = 1e-3;
  for (int step = 0; step < 500; ++step) {  // classical Runge-Kutta
    const Eigen::Vector3d a1 = acceleration(q, v), v2 = v + 0.5 * h * a1;
    const Eigen::Vector3d a2 = acceleration(q + 0.5 * h * v, v2), v3 = v + 0.5 * h * a2;
    const Eigen::Vector3d a3 = acceleration(q + 0.5 * h * v2, v3), v4 = v + h * a3;
    const Eigen::Vector3d a4 = acceleration(q + h * v3, v4);
    q += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
    v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
  }
  EXPECT_NEAR(energy(), before, 1e-7 * std::abs(before));
}

TEST(Skeleton, StiffnessIsTheSlopeOfTheForce) {
  anatomy::Specimen specimen = arm();
  specimen.joints[kElbow].range_rad = {{-0.2, 0.4}};  // 0.5 rad is past the stop
  specimen.joints[kShoulder].stiffness_Nm_rad = 1.5;
  Skeleton skeleton(specimen);
  const std::vector<double> rest(3, 0.0), torque{0.0, 0.3, -0.2};
  const Vec3 gravity(1.0, 0.5, -kGravity_m_s2);
  const auto force = [&](int j, double dq) {
    std::vector<double> q{0.0, 0.5, -0.3};
    q[static_cast<std::size_t>(j)] += dq;
    skeleton.set_pose(q);
    SkeletonLoads loads;
    loads.compute(skeleton, {gravity, rest, torque});
    return loads;
  };
  constexpr double h = 1e-5;
  const SkeletonLoads here = force(kElbow, 0.0);
  for (const int j : {kElbow, kShoulder}) {
    const Eigen::VectorXd slope = (force(j, h).force_Nm - force(j, -h).force_Nm) / (2 * h);
    EXPECT_LT((here.stiffness_Nm_rad.col(j) + slope).norm(), 1e-6 * here.stiffness_Nm_rad.norm()) << j;
  }
  EXPECT_NEAR(here.passive_Nm_rad[kElbow], kRangeStiffness_Nm_rad, 1e-12);
}

TEST(Skeleton, TheStopOnlyPushes) {
  anatomy::Specimen specimen = arm();
  specimen.joints[kElbow].range_rad = {{-0.2, 0.4}};
  Skeleton skeleton(specimen);
  SkeletonLoads loads;
  const std::vector<double> torque(3, 0.0);
  const auto stop_Nm = [&](double past_rad) {
    skeleton.set_pose(std::vector<double>{0.0, 0.4 + past_rad, 0.0});
    loads.compute(skeleton, {Vec3::Zero(), std::vector<double>{0.0, 0.0, 0.0}, torque});
    return -loads.force_Nm[kElbow];
  };
  // The toe costs half its width; torque and stiffness begin at zero.
  EXPECT_NEAR(stop_Nm(0.05), kRangeStiffness_Nm_rad * (0.05 - 0.5 * kRangeToe_rad), 1e-9);
  EXPECT_LT(stop_Nm(1e-6), 1e-6 * kRangeStiffness_Nm_rad * 1e-3);
  EXPECT_LT(loads.passive_Nm_rad[kElbow], 1e-3 * kRangeStiffness_Nm_rad);
  EXPECT_NEAR(stop_Nm(kRangeToe_rad + 1e-9), stop_Nm(kRangeToe_rad - 1e-9), 1e-5);
  stop_Nm(0.01);
  loads.compute(skeleton, {Vec3::Zero(), std::vector<double>{0.0, -50.0, 0.0}, torque});
  EXPECT_EQ(loads.damping_Nms_rad[kElbow], 0.0);
  EXPECT_EQ(loads.passive_Nm_rad[kElbow], 0.0);
}

TEST(Skeleton, LockedJointsDoNotMove) {
  Skeleton skeleton(arm());
  EXPECT_TRUE(skeleton.moves(kElbow));
  EXPECT_FALSE(skeleton.moves(kWrist));
  skeleton.set_locked(kElbow, true);
  EXPECT_FALSE(skeleton.moves(kElbow));
}

std::string refusal(const anatomy::Specimen& specimen) {
  try {
    const Skeleton skeleton(specimen);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::BadData);
    return error.what();
  }
  return "accepted";
}

TEST(Skeleton, RefusesWhatItCannotMove) {
  anatomy::Specimen ball = arm(), far = arm(), twice = arm(), loop = arm(), skewed = arm(), axisless = arm();
  ball.joints[kElbow].type = anatomy::JointType::Ball;
  EXPECT_NE(refusal(ball).find("'elbow': only hinges and welds are supported here"), std::string::npos);
  far.joints[kElbow].child = 9;
  EXPECT_NE(refusal(far).find("body 9 must be 0 .. 3"), std::string::npos);
  twice.joints[kWrist].child = 2;
  twice.joints[kWrist].parent = 0;
  EXPECT_NE(refusal(twice).find("already hangs on joint 'wrist'"), std::string::npos);
  loop.joints[kShoulder].parent = 3;
  EXPECT_NE(refusal(loop).find("loop"), std::string::npos);
  skewed.joints[kElbow].axes = {Vec3(0, std::nan(""), 0)};
  EXPECT_NE(refusal(skewed).find("axis has length nan"), std::string::npos);
  axisless.joints[kElbow].axes.clear();
  EXPECT_NE(refusal(axisless).find("exactly one axis"), std::string::npos);
}

}  // namespace
}  // namespace myotact::simulation
