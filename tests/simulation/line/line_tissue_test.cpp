#include "simulation/line/line_tissue.h"

#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.h"
#include "simulation/simulation.h"
#include "support/synthetic_specimen.h"

namespace myotact::simulation {
namespace {

constexpr int kElbow = 0;

/// Straight antagonists across a hinge, 30 mm from it, both Line muscles with fibres of 50 mm and pennation.
anatomy::Specimen line_pair() {
  anatomy::Specimen specimen = testing::antagonist_hinge();
  for (anatomy::Muscle& muscle : specimen.muscles) {
    muscle.optimal_fibre_m = 0.05;
    muscle.pennation_rad = 0.3;
  }
  return specimen;
}

SimulationSettings line_settings(Tendon tendon, double dt_s) {
  SimulationSettings settings;
  settings.dt_s = dt_s;
  settings.workers = 1;
  settings.tissue = {TissueModel::Line, TissueModel::Line};
  settings.tendon = tendon;
  return settings;
}

TEST(LineTissue, StiffnessIsTheSlopeOfTheSettledTorque) {
  for (const Tendon tendon : {Tendon::Rigid, Tendon::Elastic}) {
    for (const double activation : {0.0, 0.01, 0.5, 1.0}) {
      Simulation simulation(line_pair(), line_settings(tendon, 0.01));
      const std::array activations{activation, 0.5 * activation};
      const auto torque_Nm = [&](double q_rad) {
        EXPECT_TRUE(simulation.settle(std::array{q_rad}, activations));
        return simulation.joint(kElbow).net_torque_Nm;
      };
      constexpr double h = 1e-5;
      const double slope = (torque_Nm(0.2 + h) - torque_Nm(0.2 - h)) / (2.0 * h);
      torque_Nm(0.2);
      const JointReadout joint = simulation.joint(kElbow);
      EXPECT_NEAR(joint.stiffness_Nm_rad - joint.passive_Nm_rad, -slope, 1e-6 * (1.0 + std::abs(slope))) << activation;
      EXPECT_NEAR(joint.line_muscle_Nm_rad + joint.line_geometry_Nm_rad, -slope, 1e-6 * (1.0 + std::abs(slope)));
    }
  }
}

/// Angle after a short push, every millisecond, from the linear joint I q'' + B q' + K q = 0 in closed form.
TEST(LineTissue, AShoveRingsAndDecaysAsTheLinearJoint) {
  anatomy::Specimen specimen = line_pair();
  specimen.joints[kElbow].damping_Nms_rad = 0.005;
  Simulation simulation(specimen, line_settings(Tendon::Rigid, 1e-3));
  ASSERT_TRUE(simulation.settle(std::array{0.0}, std::array{0.01, 0.01}));
  for (const int m : {0, 1}) simulation.set_excitation(m, 0.01);
  const JointReadout joint = simulation.joint(kElbow);
  simulation.set_joint_torque(kElbow, 0.05);
  for (int i = 0; i < 10; ++i) simulation.step({});
  simulation.set_joint_torque(kElbow, 0.0);
  simulation.step({});
  const double q0 = simulation.joint(kElbow).angle_rad, v0 = simulation.joint(kElbow).velocity_rad_s;
  const double I = joint.inertia_kg_m2, K = joint.stiffness_Nm_rad, B = joint.damping_Nms_rad;
  const double decay_1_s = B / (2.0 * I), omega = std::sqrt(K / I - decay_1_s * decay_1_s);
  ASSERT_GT(omega, 1.0);
  double worst_rad = 0.0, largest_rad = 0.0;
  for (int i = 1; i <= 400; ++i) {
    simulation.step({});
    const double t = 1e-3 * i;
    const double expected =
        std::exp(-decay_1_s * t) * (q0 * std::cos(omega * t) + (v0 + decay_1_s * q0) / omega * std::sin(omega * t));
    worst_rad = std::max(worst_rad, std::abs(simulation.joint(kElbow).angle_rad - expected));
    largest_rad = std::max(largest_rad, std::abs(expected));
  }
  EXPECT_GT(omega / 6.283 * 0.4, 2.0);  // more than two periods were seen
  EXPECT_LT(worst_rad, 0.03 * largest_rad);
}

TEST(LineTissue, AnElasticTendonGivesWay) {
  Simulation rigid(line_pair(), line_settings(Tendon::Rigid, 0.01));
  Simulation elastic(line_pair(), line_settings(Tendon::Elastic, 0.01));
  for (Simulation* simulation : {&rigid, &elastic}) {
    ASSERT_TRUE(simulation->settle(std::array{0.0}, std::array{1.0, 1.0}));
    EXPECT_NEAR(simulation->joint(kElbow).net_torque_Nm, 0.0, 1e-12);
  }
  EXPECT_LT(elastic.muscle_force_N(0), rigid.muscle_force_N(0));
}

TEST(LineTissue, StepsToRestWhereItSettles) {
  Simulation settled(line_pair(), line_settings(Tendon::Elastic, 0.01));
  Simulation stepped(line_pair(), line_settings(Tendon::Elastic, 0.01));
  ASSERT_TRUE(stepped.settle(std::array{0.0}, {}));
  stepped.set_excitation(0, 0.05);
  for (int i = 0; i < 600; ++i) stepped.step({});
  const double q_rad = stepped.joint(kElbow).angle_rad;
  EXPECT_GT(q_rad, 0.01);  // the flexor alone flexes
  ASSERT_TRUE(settled.settle(std::array{q_rad}, std::array{0.05, 0.0}));
  const JointReadout there = settled.joint(kElbow);
  EXPECT_NEAR(there.net_torque_Nm, there.passive_Nm_rad * q_rad, 1e-5);
  EXPECT_NEAR(settled.muscle_force_N(0), stepped.muscle_force_N(0), 1e-4 * settled.muscle_force_N(0));
}

TEST(LineTissue, RefusesFibresThatDoNotFitTheLine) {
  anatomy::Specimen specimen = line_pair();
  specimen.muscles[0].optimal_fibre_m = 0.2;
  try {
    const Simulation simulation(specimen, line_settings(Tendon::Elastic, 0.01));
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("muscle flexor"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("for the tendon; must be at least 0"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace myotact::simulation
