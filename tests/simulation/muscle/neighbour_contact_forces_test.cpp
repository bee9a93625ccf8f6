#include "simulation/muscle/neighbour_contact_forces.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "simulation/limb/coupled_solve.h"
#include "simulation/limb/find_touches.h"
#include "simulation/limb/limb.h"
#include "simulation/limb/settle.h"
#include "simulation/limb/step.h"
#include "support/synthetic_specimen.h"

namespace myotact::simulation {
namespace {

constexpr double kMomentArm_m = 0.15;

/// A block of muscle under the lower body's far end and one below it on the upper body; nodes do not meet nodes.
anatomy::Specimen stack() {
  anatomy::Specimen specimen = testing::hinged_bones();
  specimen.bones.clear();
  specimen.joints[0].stiffness_Nm_rad = 0.0;
  testing::BarShape above, below;
  above.origin_m = {kMomentArm_m - 0.01, 0.0, -0.04};
  above.length_m = 0.02;
  above.cells = {2, 2, 2};
  below.origin_m = {kMomentArm_m - 0.02, 0.0, -0.07};
  below.length_m = below.width_m = 0.04;
  below.cells = {3, 3, 3};
  for (const auto& shape : {above, below}) {
    anatomy::Muscle block = testing::bar_muscle(shape.origin_m.z() > -0.05 ? "above" : "below", shape);
    for (std::size_t i = 0; i < block.attachments.size(); ++i) {
      const double z = block.tets.nodes_m[i].z();
      block.attachments[i] = z > -0.03 - 1e-9 ? 1 : z < -0.09 + 1e-9 ? 0 : -1;
    }
    specimen.lines.push_back(testing::bar_line(static_cast<int>(specimen.muscles.size()), shape));
    specimen.muscles.push_back(block);
  }
  return specimen;
}

/// Pressed together by 1 mm, noise on all free nodes, the faces under the nodes found.
struct Bench {
  Bench() : specimen(stack()), limb(specimen), workers(1) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> noise(-2e-4, 2e-4);
    limb.now.angle_rad[0] = -1e-3 / kMomentArm_m;
    follow_angles(limb);
    for (LimbMuscle& muscle : limb.muscles) {
      Eigen::VectorXd by(3 * muscle.tissue.free_nodes);
      for (double& value : by) value = noise(random);
      if (&muscle == &limb.muscles[0]) {
        for (Eigen::Index k = 2; k < by.size(); k += 3) by[k] -= 1e-3;
      }
      move_free_nodes(muscle, by);
    }
    find_touches(limb, workers);
  }
  Eigen::VectorXd residual() {
    see_neighbours(limb);
    Eigen::VectorXd all(size());
    Eigen::Index row = 0;
    all[size() - 1] = 0.0;
    for (LimbMuscle& muscle : limb.muscles) {
      compute_forces(muscle.tissue, limb.skeleton, {}, muscle.state, muscle.system);
      all.segment(row, muscle.system.residual_N.size()) = muscle.system.residual_N;
      row += muscle.system.residual_N.size();
      all[size() - 1] += muscle.system.joint_residual_Nm[0];
    }
    return all;
  }
  Eigen::Index size() const { return 3 * (limb.muscles[0].tissue.free_nodes + limb.muscles[1].tissue.free_nodes) + 1; }
  void move(const Eigen::VectorXd& by) {
    limb.now.angle_rad[0] += by[size() - 1];
    follow_angles(limb);
    Eigen::Index row = 0;
    for (LimbMuscle& muscle : limb.muscles) {
      move_free_nodes(muscle, by.segment(row, 3 * muscle.tissue.free_nodes));
      row += 3 * muscle.tissue.free_nodes;
    }
  }
  /// The whole tangent times a direction.
  Eigen::VectorXd multiply(const Eigen::VectorXd& along) {
    Eigen::VectorXd product = Eigen::VectorXd::Zero(size());
    Eigen::Index row = 0;
    for (LimbMuscle& muscle : limb.muscles) {
      compute_system(muscle.tissue, limb.skeleton, {}, muscle.state, muscle.system);
      muscle.follow_m_rad = along.segment(row, 3 * muscle.tissue.free_nodes);
      row += 3 * muscle.tissue.free_nodes;
    }
    row = 0;
    const double turn = along[size() - 1];
    for (LimbMuscle& muscle : limb.muscles) {
      const TissueSystem& system = muscle.system;
      const Eigen::VectorXd part = muscle.follow_m_rad.col(0);
      Eigen::MatrixXd minus_coupled = Eigen::MatrixXd::Zero(part.size(), 1);
      subtract_followed_coupling(limb, muscle, minus_coupled);
      product.segment(row, part.size()) =
          system.matrix.lower().selfadjointView<Eigen::Lower>() * part - minus_coupled.col(0) +
          system.mean.factor_Nm * system.mean.gradient * system.mean.gradient.dot(part) +
          system.coupling_N_rad.col(0) * turn;
      product[size() - 1] += system.coupling_N_rad.col(0).dot(part) + system.joint_stiffness_Nm_rad(0, 0) * turn;
      row += part.size();
    }
    return product;
  }

  anatomy::Specimen specimen;
  Limb limb;
  WorkerPool workers;
};

/// The stack after two seconds under a torque that presses 2 N on it.
struct Pressed {
  explicit Pressed(int threads) : specimen(stack()), limb(specimen), workers(threads) {
    limb.external_torque_Nm[0] = -2.0 * kMomentArm_m;
    for (int i = 0; i < 200; ++i) {
      push_history(limb);
      sound = sound && advance(limb, {0.01, i > 0}, workers).sound;
    }
  }
  anatomy::Specimen specimen;
  Limb limb;
  WorkerPool workers;
  bool sound = true;
};

}  // namespace

TEST(NeighbourContact, TangentIsTheSlopeOfTheForcesOnBoth) {
  Bench bench;
  bench.residual();
  ASSERT_GT(bench.limb.muscles[0].system.contact_N, 1.0);
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  Eigen::VectorXd along(bench.size());
  for (double& value : along) value = normal(random);
  along[along.size() - 1] /= kMomentArm_m;
  const Eigen::VectorXd expected = bench.multiply(along);
  const auto error = [&](double h) {
    bench.move(h * along);
    const Eigen::VectorXd up = bench.residual();
    bench.move(-2.0 * h * along);
    const Eigen::VectorXd down = bench.residual();
    bench.move(h * along);
    return ((up - down) / (2.0 * h) - expected).norm();
  };
  EXPECT_LT(error(1e-7), 1e-5 * expected.norm());
  EXPECT_NEAR(std::log2(error(4e-6) / error(2e-6)), 2.0, 0.3);
}

TEST(NeighbourContact, WhatOneMusclePressesTheOtherBears) {
  Bench bench;
  Vec3 sum = Vec3::Zero(), above = Vec3::Zero();
  std::vector<Eigen::VectorXd> with;
  bench.residual();
  for (LimbMuscle& muscle : bench.limb.muscles) with.push_back(muscle.system.internal_N);
  for (LimbMuscle& muscle : bench.limb.muscles) muscle.state.touches.clear();
  bench.residual();
  for (std::size_t m = 0; m < 2; ++m) {
    const Eigen::VectorXd contact = with[m] - bench.limb.muscles[m].system.internal_N;
    for (Eigen::Index i = 0; i < contact.size(); i += 3) sum += contact.segment<3>(i);
    if (m == 0) above = sum;
  }
  EXPECT_GT(above.norm(), 1.0);
  EXPECT_LT(sum.norm(), 1e-10 * above.norm());
}

TEST(NeighbourContact, AStackBearsWhatPressesItAndComesToRest) {
  const Pressed pressed(1);
  EXPECT_TRUE(pressed.sound);
  const MuscleReadout &above = pressed.limb.muscles[0].readout, &below = pressed.limb.muscles[1].readout;
  EXPECT_NEAR(pressed.limb.now.velocity_rad_s[0], 0.0, 1e-3);
  EXPECT_NEAR(above.torque_Nm[0], 2.0 * kMomentArm_m, 0.01 * 2.0 * kMomentArm_m);
  EXPECT_NEAR(above.contact_N, below.contact_N, 1e-9);
  EXPECT_NEAR(above.contact_N, 2.0, 0.05 * 2.0);  // the upper block is wedged, and its foot turns down at the rim
  EXPECT_LT(above.contact_depth_m, 1e-3);
}

TEST(NeighbourContact, WorkersDoNotChangeABit) {
  const std::uint64_t one = hash_of_state(Pressed(1).limb);
  EXPECT_EQ(one, hash_of_state(Pressed(2).limb));
  EXPECT_EQ(one, hash_of_state(Pressed(8).limb));
}

// The lower block is as stiff in series with the upper one as it is soft: without the coupling the joint would be far
// too stiff.
TEST(NeighbourContact, JointStiffnessThroughTwoMusclesIsTheSlopeOfTheTorque) {
  const anatomy::Specimen specimen = stack();
  Limb limb(specimen);
  WorkerPool workers(1);
  const double q = -2e-3 / kMomentArm_m, h = 1e-4 / kMomentArm_m;
  const auto torque = [&](double angle) {
    EXPECT_TRUE(settle_limb(limb, {&angle, 1}, workers));
    return limb.muscles[0].readout.torque_Nm[0];
  };
  const double up = torque(q + h), down = torque(q - h);
  torque(q);
  refresh_stiffness(limb, workers);
  const double stiffness = limb.muscles[0].stiffness_Nm_rad[0];
  EXPECT_NEAR(stiffness, (down - up) / (2.0 * h), 0.03 * stiffness);
  EXPECT_GT(limb.muscles[0].contact_stiffness_Nm_rad[0], 0.0);
  // One muscle after the other, as a step does it, comes to the same.
  for (LimbMuscle& muscle : limb.muscles) muscle.follow_m_rad.setZero();
  for (int round = 0; round < 60; ++round) {
    for (LimbMuscle& muscle : limb.muscles) refresh_muscle_stiffness(limb, muscle);
  }
  EXPECT_NEAR(limb.muscles[0].stiffness_Nm_rad[0], stiffness, 0.01 * stiffness);
}

// A bar clamped at both ends, taut, a fifth shorter: what its middle loses in length it gains in section.
TEST(MuscleTissue, AShortenedMuscleWidensAsItsVolumeDemands) {
  testing::BarShape shape;
  shape.cells = {12, 2, 2};
  anatomy::Specimen specimen = testing::single_muscle(shape);
  specimen.bones.clear();
  specimen.joints[0].centre_m = {0.0, 0.0, -1.0};  // far away: the insertion moves along the bar
  Limb limb(specimen);
  WorkerPool workers(1);
  limb.muscles[0].state.activation = 0.5;
  const double turn = 0.2 * shape.length_m / (1.0 + shape.origin_m.z());
  ASSERT_TRUE(settle_limb(limb, {&turn, 1}, workers));
  const MuscleTissue& tissue = limb.muscles[0].tissue;
  const double middle = shape.origin_m.x() + 0.5 * shape.length_m, cell = shape.length_m / 12.0, half = 0.01;
  const auto at = [&](const Vec3& rest) {
    for (std::size_t i = 0; i < tissue.mesh.nodes_m.size(); ++i) {
      if ((tissue.mesh.nodes_m[i] - rest).norm() < 1e-9) {
        return node_vector(limb.muscles[0].state.now.position_m, static_cast<int>(i));
      }
    }
    return Vec3(Vec3::Constant(std::nan("")));
  };
  const double z = shape.origin_m.z();
  const double wide = (at({middle, half, z}) - at({middle, -half, z})).norm();
  const double high = (at({middle, 0.0, z + half}) - at({middle, 0.0, z - half})).norm();
  const double length = (at({middle + cell, 0.0, z}) - at({middle - cell, 0.0, z})).norm() / (2.0 * cell);
  EXPECT_NEAR(length, 0.8, 0.08);
  EXPECT_NEAR(wide * high / (4.0 * half * half), 1.0 / length, 0.05 / length);
}

}  // namespace myotact::simulation
