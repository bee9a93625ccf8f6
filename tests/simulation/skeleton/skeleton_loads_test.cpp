#include "simulation/skeleton/skeleton_loads.h"

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

// Random trees of bodies in random poses: what the skeleton says about motion against differences of where its bodies
// are, and its equations of motion against Lagrange's.

namespace myotact::simulation {
namespace {

using Angles = std::vector<double>;

constexpr double kTreeStep_rad = 1e-5;
/// Error of a central difference with that step: its square, and rounding over it, over arms of about a metre.
constexpr double kTreeDifference = 1e-8;

Vec3 random_vector(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return Vec3::NullaryExpr([&] { return uniform(random); });
}

anatomy::Body random_body(int number, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.1, 1.0);
  // Of a body: the sum of squares of three ways.
  Mat3 spread = Mat3::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vec3 way = random_vector(random);
    spread += way.squaredNorm() * Mat3::Identity() - way * way.transpose();
  }
  return {"body" + std::to_string(number),
          uniform(random),
          random_vector(random),
          {spread(0, 0), spread(1, 1), spread(2, 2), spread(0, 1), spread(0, 2), spread(1, 2)},
          false};
}

/// Body 0 stands; every other hangs by a hinge, or one in five by a weld, on any of those before it. The joints are
/// listed in any order.
anatomy::Specimen random_tree(std::mt19937& random) {
  anatomy::Specimen specimen;
  const int bodies = std::uniform_int_distribution<int>(2, 8)(random);
  for (int b = 0; b < bodies; ++b) {
    specimen.bodies.push_back(random_body(b, random));
    if (b == 0) continue;
    anatomy::Joint joint;
    joint.key = "joint" + std::to_string(b);
    joint.parent = std::uniform_int_distribution<int>(std::max(0, b - 3), b - 1)(random);
    joint.child = b;
    joint.centre_m = random_vector(random);
    joint.axes = {random_vector(random).normalized()};
    joint.range_rad = {{-10.0, 10.0}};
    if (random() % 5 == 0) joint.type = anatomy::JointType::Weld;
    specimen.joints.push_back(joint);
  }
  std::shuffle(specimen.joints.begin(), specimen.joints.end(), random);
  return specimen;
}

Angles random_angles(int count, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-3.0, 3.0);
  Angles angles(static_cast<std::size_t>(count));
  for (double& angle : angles) angle = uniform(random);
  return angles;
}

Angles moved(Angles angles, const Angles& way, double by) {
  for (std::size_t j = 0; j < angles.size(); ++j) angles[j] += by * way[j];
  return angles;
}

Angles unit_way(int count, int joint) {
  Angles way(static_cast<std::size_t>(count), 0.0);
  way[static_cast<std::size_t>(joint)] = 1.0;
  return way;
}

TEST(SkeletonTree, PointsOfEveryBodyGoWhereTheirDerivativesSay) {
  std::mt19937 random(51);
  for (int round = 0; round < 30; ++round) {
    const anatomy::Specimen specimen = random_tree(random);
    Skeleton here(specimen), ahead(specimen), behind(specimen);
    const int joints = here.joint_count();
    const Angles q = random_angles(joints, random);
    here.set_pose(q);
    for (int body = 0; body < here.body_count(); ++body) {
      const Vec3 rest_m = random_vector(random), now_m = here.body_pose(body) * rest_m;
      for (int j = 0; j < joints; ++j) {
        ahead.set_pose(moved(q, unit_way(joints, j), kTreeStep_rad));
        behind.set_pose(moved(q, unit_way(joints, j), -kTreeStep_rad));
        const Vec3 ahead_m = ahead.body_pose(body) * rest_m, behind_m = behind.body_pose(body) * rest_m;
        const Vec3 slope = (ahead_m - behind_m) / (2.0 * kTreeStep_rad);
        ASSERT_LT((here.point_derivative(body, j, now_m) - slope).norm(), kTreeDifference) << body << " " << j;
        EXPECT_EQ(here.is_distal(body, j), slope.norm() > kTreeDifference) << body << " " << j;
        for (int k = 0; k < joints; ++k) {
          const Vec3 bend = (ahead.point_derivative(body, k, ahead_m) - behind.point_derivative(body, k, behind_m)) /
                            (2.0 * kTreeStep_rad);
          ASSERT_LT((here.point_second_derivative(body, j, k, now_m) - bend).norm(), kTreeDifference)
              << body << " " << j << " " << k;
        }
      }
    }
  }
}

/// Kinetic energy at the rates `v`, from where the bodies are a moment before and after.
double kinetic_energy_J(const anatomy::Specimen& specimen, const Angles& q, const Angles& v) {
  Skeleton here(specimen), ahead(specimen), behind(specimen);
  here.set_pose(q);
  ahead.set_pose(moved(q, v, kTreeStep_rad));
  behind.set_pose(moved(q, v, -kTreeStep_rad));
  double sum_J = 0.0;
  for (int b = 0; b < here.body_count(); ++b) {
    const Vec3 velocity = (ahead.com_W(b) - behind.com_W(b)) / (2.0 * kTreeStep_rad);
    const Eigen::AngleAxisd turned(Mat3(ahead.body_pose(b).rotation * behind.body_pose(b).rotation.transpose()));
    const Vec3 omega = turned.angle() / (2.0 * kTreeStep_rad) * turned.axis();
    const auto& [xx, yy, zz, xy, xz, yz] = specimen.bodies[static_cast<std::size_t>(b)].inertia_kg_m2;
    Mat3 inertia;
    inertia << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    const Vec3 omega_L = here.body_pose(b).rotation.transpose() * omega;
    sum_J += 0.5 * here.body(b).mass_kg * velocity.squaredNorm() + 0.5 * omega_L.dot(inertia * omega_L);
  }
  return sum_J;
}

SkeletonLoads loads_at(Skeleton& skeleton, const Angles& q, const Angles& v, const Vec3& gravity_m_s2) {
  const Angles none(q.size(), 0.0);
  SkeletonLoads loads;
  skeleton.set_pose(q);
  loads.compute(skeleton, {gravity_m_s2, v, none});
  return loads;
}

/// Welds have no rate.
Angles random_rates(const Skeleton& skeleton, std::mt19937& random) {
  Angles rates = random_angles(skeleton.joint_count(), random);
  for (int j = 0; j < skeleton.joint_count(); ++j) {
    if (!skeleton.moves(j)) rates[static_cast<std::size_t>(j)] = 0.0;
  }
  return rates;
}

TEST(SkeletonTree, TheMassMatrixHoldsTheKineticEnergy) {
  std::mt19937 random(52);
  for (int round = 0; round < 60; ++round) {
    const anatomy::Specimen specimen = random_tree(random);
    Skeleton skeleton(specimen);
    const Angles q = random_angles(skeleton.joint_count(), random), v = random_rates(skeleton, random);
    const SkeletonLoads loads = loads_at(skeleton, q, v, Vec3::Zero());
    const Eigen::Map<const Eigen::VectorXd> rates(v.data(), skeleton.joint_count());
    const double energy_J = kinetic_energy_J(specimen, q, v);
    EXPECT_NEAR(0.5 * rates.dot(loads.mass_kg_m2 * rates), energy_J, 1e-7 * energy_J);
  }
}

/// d/dt (M v) - 1/2 d(v M v)/dq = force, with no acceleration: all of the force is centrifugal.
TEST(SkeletonTree, CentrifugalTorquesAreThoseOfLagrange) {
  std::mt19937 random(53);
  for (int round = 0; round < 40; ++round) {
    Skeleton skeleton(random_tree(random));
    const int joints = skeleton.joint_count();
    const Angles q = random_angles(joints, random), v = random_rates(skeleton, random);
    const Eigen::Map<const Eigen::VectorXd> rates(v.data(), joints);
    const auto mass_slope = [&](const Angles& way) {
      const Eigen::MatrixXd ahead = loads_at(skeleton, moved(q, way, kTreeStep_rad), v, Vec3::Zero()).mass_kg_m2;
      const Eigen::MatrixXd behind = loads_at(skeleton, moved(q, way, -kTreeStep_rad), v, Vec3::Zero()).mass_kg_m2;
      return Eigen::MatrixXd((ahead - behind) / (2.0 * kTreeStep_rad));
    };
    Eigen::VectorXd expected = -mass_slope(v) * rates;
    for (int j = 0; j < joints; ++j) expected[j] += 0.5 * rates.dot(mass_slope(unit_way(joints, j)) * rates);
    const SkeletonLoads loads = loads_at(skeleton, q, v, Vec3::Zero());
    EXPECT_LT((loads.force_Nm - expected).norm(), 1e-6 * (1.0 + expected.norm()));
  }
}

TEST(SkeletonTree, WeightIsTheSlopeOfItsEnergyAndItsStiffnessTheSecondOne) {
  std::mt19937 random(54);
  for (int round = 0; round < 40; ++round) {
    Skeleton skeleton(random_tree(random));
    const int joints = skeleton.joint_count();
    const Angles q = random_angles(joints, random), still(q.size(), 0.0);
    const Vec3 gravity_m_s2 = 9.81 * random_vector(random);
    const auto energy_J = [&](const Angles& angles) {
      skeleton.set_pose(angles);
      double sum_J = 0.0;
      for (int b = 0; b < skeleton.body_count(); ++b) {
        sum_J -= skeleton.body(b).mass_kg * gravity_m_s2.dot(skeleton.com_W(b));
      }
      return sum_J;
    };
    const SkeletonLoads here = loads_at(skeleton, q, still, gravity_m_s2);
    for (int j = 0; j < joints; ++j) {
      const Angles ahead = moved(q, unit_way(joints, j), kTreeStep_rad);
      const Angles behind = moved(q, unit_way(joints, j), -kTreeStep_rad);
      EXPECT_NEAR(here.force_Nm[j], -(energy_J(ahead) - energy_J(behind)) / (2.0 * kTreeStep_rad), 1e-7);
      const Eigen::VectorXd bend = (loads_at(skeleton, ahead, still, gravity_m_s2).force_Nm -
                                    loads_at(skeleton, behind, still, gravity_m_s2).force_Nm) /
                                   (2.0 * kTreeStep_rad);
      EXPECT_LT((here.stiffness_Nm_rad.col(j) + bend).norm(), 1e-6);
    }
  }
}

}  // namespace
}  // namespace myotact::simulation
