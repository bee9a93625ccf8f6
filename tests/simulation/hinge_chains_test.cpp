#include "anatomy/hinge_chains.h"

#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "simulation/skeleton/skeleton.h"
#include "simulation/skeleton/skeleton_loads.h"

namespace myotact::anatomy {
namespace {

const Vec3 kCentre_m(0.1, 0.2, 0.5);
constexpr double kLength_m = 0.3;

/// A pendulum of a small heavy ball, hung on a joint of the given type.
Specimen pendulum(JointType type) {
  Specimen specimen;
  Body trunk, bob;
  trunk.key = "trunk";
  trunk.mass_kg = 1.0;
  trunk.inertia_kg_m2 = {1.0, 1.0, 1.0, 0.0, 0.0, 0.0};
  bob = trunk;
  bob.key = "bob";
  bob.com_m = kCentre_m - kLength_m * Vec3::UnitZ();
  bob.inertia_kg_m2 = {1e-9, 1e-9, 1e-9, 0.0, 0.0, 0.0};
  specimen.bodies = {trunk, bob};
  Joint joint;
  joint.key = "hip";
  joint.type = type;
  joint.parent = 0;
  joint.child = 1;
  joint.centre_m = kCentre_m;
  joint.axes = {Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitZ()};
  joint.axes.resize(type == JointType::Ball ? 3 : type == JointType::Universal ? 2 : 1);
  joint.range_rad.assign(joint.axes.size(), {-1.0, 1.2});
  specimen.joints = {joint};
  return specimen;
}

TEST(HingeChains, ABallTurnsAboutItsAxesOneAfterTheOther) {
  const Specimen chain = with_hinge_chains(pendulum(JointType::Ball));
  ASSERT_EQ(chain.joints.size(), 3u);
  EXPECT_EQ(chain.joints[0].key, "hip");
  EXPECT_EQ(chain.joints[2].key, "hip.3");
  simulation::Skeleton skeleton(chain);
  skeleton.set_pose(std::vector<double>{0.4, -0.3, 0.8});
  const Vec3 p_L = kCentre_m + Vec3(0.05, -0.02, -0.1);
  using Turn = Eigen::AngleAxisd;
  const Vec3 expected = kCentre_m + Turn(0.4, Vec3::UnitY()) *
                                        (Turn(-0.3, Vec3::UnitX()) * (Turn(0.8, Vec3::UnitZ()) * (p_L - kCentre_m)));
  EXPECT_LT((skeleton.body_pose(1) * p_L - expected).norm(), 1e-14);
}

TEST(HingeChains, HingesAndWeldsStayAsTheyAre) {
  EXPECT_EQ(with_hinge_chains(pendulum(JointType::Hinge)).bodies.size(), 2u);
  EXPECT_EQ(with_hinge_chains(pendulum(JointType::Universal)).joints.size(), 2u);
}

/// A universal joint swings in a cone at the angular speed sqrt(g / (l cos a)) (Huygens 1673): the deviation's x and y
/// then stay on a circle.
TEST(HingeChains, AUniversalJointSwingsInACone) {
  simulation::Skeleton skeleton(with_hinge_chains(pendulum(JointType::Universal)));
  simulation::SkeletonLoads loads;
  const double tilt_rad = 0.5, gravity_m_s2 = 9.81;
  const double speed_rad_s = std::sqrt(gravity_m_s2 / (kLength_m * std::cos(tilt_rad)));
  using State = Eigen::Vector4d;  // angles, velocities
  const auto rate = [&](const State& s) {
    const std::vector<double> q{s[0], s[1]}, v{s[2], s[3]}, none{0.0, 0.0};
    skeleton.set_pose(q);
    loads.compute(skeleton, {Vec3(0, 0, -gravity_m_s2), v, none});
    State d;
    d << s.tail<2>(), loads.mass_kg_m2.inverse() * loads.force_Nm;
    return d;
  };
  // At q = (0, -tilt) the bob is out along -y and goes along x: a turn about the first axis, which carries (0, .,
  // -cos).
  State s(0.0, -tilt_rad, -speed_rad_s * std::tan(tilt_rad), 0.0);
  const double dt_s = 1e-3;
  double largest = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const State a = rate(s), b = rate(s + 0.5 * dt_s * a), c = rate(s + 0.5 * dt_s * b), d = rate(s + dt_s * c);
    s += dt_s / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    skeleton.set_pose(std::vector<double>{s[0], s[1]});
    const Vec3 out_m = skeleton.com_W(1) - kCentre_m;
    largest = std::max(largest, std::abs(std::hypot(out_m.x(), out_m.y()) / kLength_m - std::sin(tilt_rad)));
  }
  EXPECT_LT(largest, 1e-5);  // the links' own mass is a millionth of the bob's
}

}  // namespace
}  // namespace myotact::anatomy
