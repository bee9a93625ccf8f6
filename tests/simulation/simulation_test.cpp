#include "simulation/simulation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "simulation/curves/fibre_curves.h"
#include "support/skin_places.h"
#include "support/synthetic_specimen.h"

namespace myotact::simulation {
namespace {

using messages::ToolState;
using testing::press_tool;

/// Coarse bars: what these tests compare does not depend on the mesh.
testing::BarShape coarse_bar() {
  testing::BarShape shape;
  shape.cells = {4, 1, 1};
  return shape;
}

/// A triangle in the middle of the muscle's upper side.
int top_triangle(const anatomy::Specimen& specimen, int muscle) {
  const geometry::TriangleMesh& skin = specimen.muscles[static_cast<std::size_t>(muscle)].skin;
  int best = 0;
  double nearest = 1e300;
  for (std::size_t t = 0; t < skin.triangles.size(); ++t) {
    Vec3 centre = Vec3::Zero();
    for (int v : skin.triangles[t]) centre += skin.positions_m[static_cast<std::size_t>(v)] / 3.0;
    const double distance = (centre - Vec3(-0.03, 0.0, 0.04)).norm();
    if (distance < nearest) {
      nearest = distance;
      best = static_cast<int>(t);
    }
  }
  return best;
}

std::uint64_t hash_after_steps(int workers) {
  const anatomy::Specimen specimen = testing::coarse_antagonist_hinge();
  SimulationSettings settings;
  settings.workers = workers;
  Simulation simulation(specimen, settings);
  simulation.set_excitation(0, 0.8);
  simulation.set_excitation(1, 0.3);
  for (int i = 0; i < 5; ++i) {
    const ToolState tool = press_tool(0, 3, Vec3(-0.03, 0.0, 0.035), 200.0);
    simulation.step({&tool, 1});
  }
  return simulation.state_hash();
}

}  // namespace

class SimulationOf : public ::testing::TestWithParam<TissueModel> {};
INSTANTIATE_TEST_SUITE_P(Models, SimulationOf, ::testing::Values(TissueModel::Fem, TissueModel::MassSpring));

TEST_P(SimulationOf, IsometricForceOfAStraightBarIsTheLineModels) {
  const anatomy::Specimen specimen = testing::single_muscle(coarse_bar());
  Simulation simulation(specimen, {.tissue = {GetParam()}});
  const double peak_N = specimen.muscles[0].peak_force_N;
  for (double a : {0.0, 0.5, 1.0}) {
    const double q = 0.0;
    ASSERT_TRUE(simulation.settle({&q, 1}, {&a, 1}));
    const double line_N = peak_N * (a * active_force_length(0.8) + passive_force_length(0.8));
    EXPECT_NEAR(simulation.muscle_force_N(0), line_N, 1e-6 * peak_N);
    // Virtual work: the torque of a straight pull is the force times its moment arm.
    EXPECT_NEAR(simulation.muscle_torque_Nm(0, 0), 0.03 * line_N, 1e-7 * peak_N);
  }
}

TEST_P(SimulationOf, StiffnessIsTheSlopeOfTheTorque) {
  const anatomy::Specimen specimen = testing::coarse_antagonist_hinge();
  Simulation simulation(specimen, {.tissue = {GetParam(), GetParam()}});
  const double h = 0.5 * 3.14159265358979 / 180.0;
  const std::array<double, 2> activations{0.5, 0.3};
  const auto torque_at = [&](double q) {
    EXPECT_TRUE(simulation.settle({&q, 1}, activations));
    return simulation.joint(0).net_torque_Nm;
  };
  const double slope = (torque_at(0.1 + h) - torque_at(0.1 - h)) / (2.0 * h);
  torque_at(0.1);
  const JointReadout readout = simulation.joint(0);
  EXPECT_NEAR(readout.stiffness_Nm_rad - readout.passive_Nm_rad, -slope, 0.01 * std::abs(slope));
}

TEST(Simulation, OneTwoAndFourWorkersGiveTheSameBits) {
  const std::uint64_t one = hash_after_steps(1);
  EXPECT_EQ(one, hash_after_steps(2));
  EXPECT_EQ(one, hash_after_steps(4));
}

TEST(Simulation, EqualAntagonistsMoveNothingAndALockedJointStays) {
  const anatomy::Specimen specimen = testing::coarse_antagonist_hinge();
  Simulation simulation(specimen, {});
  simulation.set_excitation(0, 0.5);
  simulation.set_excitation(1, 0.5);
  for (int i = 0; i < 10; ++i) simulation.step({});
  EXPECT_NEAR(simulation.joint(0).angle_rad, 0.0, 1e-4);  // the mesh's diagonals are not mirror images
  simulation.set_joint_locked(0, true);
  const double angle = simulation.joint(0).angle_rad;
  simulation.set_excitation(1, 0.0);
  for (int i = 0; i < 3; ++i) simulation.step({});
  EXPECT_EQ(simulation.joint(0).angle_rad, angle);
}

TEST(Simulation, StepsComeToRestWhereSettleDoes) {
  const anatomy::Specimen specimen = testing::coarse_antagonist_hinge();
  Simulation simulation(specimen, {});
  const std::array<double, 2> activations{0.4, 0.2};
  simulation.set_excitation(0, activations[0]);
  simulation.set_excitation(1, activations[1]);
  for (int i = 0; i < 100; ++i) simulation.step({});
  const double q = simulation.joint(0).angle_rad, torque = simulation.joint(0).net_torque_Nm;
  EXPECT_NEAR(torque, simulation.joint(0).passive_Nm_rad * q, 1e-3);
  ASSERT_TRUE(simulation.settle({&q, 1}, activations));
  EXPECT_NEAR(simulation.joint(0).net_torque_Nm, torque, 1e-3 * torque);
}

TEST(Simulation, ASpringOnTheSkinPullsAndItsComplianceTellsHowFar) {
  const anatomy::Specimen specimen = testing::coarse_antagonist_hinge();
  Simulation simulation(specimen, {});
  simulation.set_joint_locked(0, true);
  const double q = 0.0;
  ASSERT_TRUE(simulation.settle({&q, 1}, {}));
  const int triangle = top_triangle(specimen, 0);
  const Vec3 start = testing::skin_centre_m(simulation, specimen, 0, triangle);
  const double stiffness_N_m = 100.0;
  const ToolState tool = press_tool(0, triangle, start - Vec3(0.0, 0.0, 1e-4), stiffness_N_m);
  simulation.step({&tool, 1});
  const Vec3 moved = testing::skin_centre_m(simulation, specimen, 0, triangle) - start;
  const Vec3 force = stiffness_N_m * (to_vec3(tool.contact.target_world_m) - start - moved);
  messages::LocalModel model;
  simulation.write_local_model(tool, model);
  const Mat3 compliance =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(model.contact.compliance_m_N.data());
  EXPECT_LT((compliance * force - moved).norm(), 0.01 * moved.norm());
  EXPECT_LT(moved.z(), 0.0);
}

TEST(Simulation, APushOnABoneTurnsTheJoint) {
  const anatomy::Specimen specimen = testing::hinged_bones();
  Simulation simulation(specimen, {});
  ToolState tool = press_tool(1, 0, Vec3::Zero(), 50.0);
  const std::array<int, 3>& triangle = specimen.bones[1].surface.triangles[0];
  Vec3 start = Vec3::Zero();
  for (int v : triangle) start += specimen.bones[1].surface.positions_m[static_cast<std::size_t>(v)] / 3.0;
  tool.contact.target_world_m = to_array(start + Vec3(0.0, 0.0, 0.01));
  simulation.step({&tool, 1});
  EXPECT_GT(simulation.joint(0).angle_rad, 0.0);
}

// The same push once more, from the same rest, by a spring ten times as stiff: the point goes where the compliance that
// the first push told says, although no tissue is in it.
TEST(Simulation, ThePushedBoneTellsItsForceAndHowFarItsJointYields) {
  const anatomy::Specimen specimen = testing::hinged_bones();
  const std::array<int, 3>& triangle = specimen.bones[1].surface.triangles[0];
  Vec3 start = Vec3::Zero();
  for (int v : triangle) start += specimen.bones[1].surface.positions_m[static_cast<std::size_t>(v)] / 3.0;
  for (const double stiffness_N_m : {5.0, 50.0}) {
    Simulation simulation(specimen, {});
    ToolState tool = press_tool(1, 0, Vec3::Zero(), stiffness_N_m);
    tool.contact.target_world_m = to_array(start + Vec3(0.0, 0.0, 1e-3));
    simulation.step({&tool, 1});
    Vec3 moved = simulation.body_pose(1) * start - start;
    messages::LocalModel model;
    simulation.write_local_model(tool, model);
    EXPECT_EQ(model.contact.surface, 1);
    const Vec3 force = to_vec3(model.contact.force_world_N);
    EXPECT_LT((force - stiffness_N_m * (to_vec3(tool.contact.target_world_m) - start - moved)).norm(),
              1e-9 * force.norm());
    const Mat3 compliance =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(model.contact.compliance_m_N.data());
    EXPECT_LT((compliance * force - moved).norm(), 0.01 * moved.norm());
    tool.contact = {};
    simulation.step({&tool, 1});
    simulation.write_local_model(tool, model);
    EXPECT_EQ(model.contact.surface, -1);
  }
}

// Rod of 0.2 m, hinged at its end, no spring or damper: the mathematical period of small swings is 2 pi sqrt(2 L / 3
// g).
TEST(Simulation, ARodSwingsWithThePeriodOfAPendulum) {
  anatomy::Specimen specimen = testing::hinged_bones();
  specimen.joints[0].stiffness_Nm_rad = specimen.joints[0].damping_Nms_rad = 0.0;
  specimen.bodies[1].inertia_kg_m2[0] = 1e-9;  // a thin rod
  SimulationSettings settings;
  settings.dt_s = 1e-3;
  settings.gravity_m_s2 = {9.81, 0.0, 0.0};  // along the rod
  Simulation simulation(specimen, settings);
  const double amplitude = 0.02;
  ASSERT_TRUE(simulation.settle({&amplitude, 1}, {}));
  double last = amplitude, crossing = 0.0;
  while (crossing == 0.0 && simulation.time_s() < 1.0) {
    simulation.step({});
    const double now = simulation.joint(0).angle_rad;
    if (now <= 0.0) crossing = simulation.time_s() - settings.dt_s * now / (now - last);
    last = now;
  }
  const double period = 2.0 * 3.14159265358979 * std::sqrt(2.0 * 0.2 / (3.0 * 9.81));
  EXPECT_NEAR(4.0 * crossing, period, 2e-3 * period);  // the first step is of first order
}

// Rod of 0.2 m and 0.2 kg on a hinge of 6 N m/rad and 0.02 N m s/rad, taken at its end: I = m L^2 / 3 + what the rod
// has about itself is 2.667e-3 kg m^2; mobility L^2 / I, stiffness K / I, damping D / I, all along z.
TEST(Simulation, TheGripTellsHowAFreePointOfABoneMoves) {
  const anatomy::Specimen specimen = testing::hinged_bones();
  Simulation simulation(specimen, {});
  ToolState tool;
  tool.tool_position_world_m = {0.21, 0.0, 0.0};
  messages::LocalModel model;
  simulation.write_local_model(tool, model);
  const double inertia_kg_m2 = 0.2 * 0.2 * 0.2 / 3.0;
  const messages::LocalGrip& grip = model.grip;
  EXPECT_EQ(grip.body, 1);
  EXPECT_LT((to_vec3(grip.point_rest_m) - Vec3(0.2, 0.0, 0.0)).norm(), 1e-12);
  EXPECT_EQ(grip.position_world_m, grip.point_rest_m);
  for (std::size_t k = 0; k < 9; ++k) {
    EXPECT_NEAR(grip.mobility_1_kg[k], k == 8 ? 0.04 / inertia_kg_m2 : 0.0, 1e-9);
    EXPECT_NEAR(grip.stiffness_1_s2[k], k == 8 ? 6.0 / inertia_kg_m2 : 0.0, 1e-6);
    EXPECT_NEAR(grip.damping_1_s[k], k == 8 ? 0.02 / inertia_kg_m2 : 0.0, 1e-9);
  }
  tool.tool_position_world_m = {0.25, 0.0, 0.0};  // 50 mm away: out of reach
  simulation.write_local_model(tool, model);
  EXPECT_EQ(model.grip.body, -1);
}

/// Velocity of the tip of two rods in a row, bent, after one step of 0.1 ms under a force on it.
Vec3 tip_velocity_m_s(const anatomy::Specimen& specimen, const Vec3& force_N, messages::LocalGrip& grip) {
  SimulationSettings settings;
  settings.dt_s = 1e-4;
  Simulation simulation(specimen, settings);
  const std::array<double, 2> bent_rad{0.4, -0.7};
  EXPECT_TRUE(simulation.settle(bent_rad, {}));
  ToolState tool;
  tool.grabbed_body = 2;
  tool.body_point_rest_m = {0.4, 0.0, 0.0};
  messages::LocalModel model;
  simulation.write_local_model(tool, model);
  grip = model.grip;
  tool.body_stiffness_N_m = 1.0;  // so soft that the force stays what it is
  tool.body_target_world_m = to_array(to_vec3(grip.position_world_m) + force_N);
  simulation.step({&tool, 1});
  simulation.write_local_model(tool, model);
  return to_vec3(model.grip.velocity_world_m_s);
}

TEST(Simulation, TheGripsMobilityIsThatOfAllJointsTogether) {
  anatomy::Specimen specimen = testing::hinged_bones();
  specimen.bodies.push_back(specimen.bodies[1]);
  specimen.bodies[2].key = "paw";
  specimen.bodies[2].com_m.x() += 0.2;
  specimen.joints.push_back(specimen.joints[0]);
  specimen.joints[1].key = "carpus";
  specimen.joints[1].parent = 1;
  specimen.joints[1].child = 2;
  specimen.joints[1].centre_m = {0.2, 0.0, 0.0};
  specimen.joints[1].range_rad = {{-1.5, 1.5}};
  messages::LocalGrip grip;
  const Vec3 free_m_s = tip_velocity_m_s(specimen, Vec3::Zero(), grip);
  for (int k = 0; k < 3; ++k) {
    const Vec3 pushed_m_s = tip_velocity_m_s(specimen, 0.5 * Vec3::Unit(k), grip);
    const Vec3 mobility_1_kg = (pushed_m_s - free_m_s) / (0.5 * 1e-4);
    for (int i = 0; i < 3; ++i) {  // 0.5 %: dampers and a turn by 1e-5 rad within the step
      EXPECT_NEAR(grip.mobility_1_kg[static_cast<std::size_t>(3 * i + k)], mobility_1_kg[i], 0.005 * 30.0);
    }
  }
  EXPECT_GT(grip.mobility_1_kg[0], 1.0);  // bent, the tip can also go along
}

TEST(Simulation, AGripOnABonePullsAndReportsItsForce) {
  const anatomy::Specimen specimen = testing::hinged_bones();
  Simulation simulation(specimen, {});
  ToolState tool;
  tool.grabbed_body = 1;
  tool.body_point_rest_m = {0.2, 0.0, 0.0};
  tool.body_target_world_m = {0.2, 0.0, 0.01};
  tool.body_stiffness_N_m = 500.0;
  for (int i = 0; i < 200; ++i) simulation.step({&tool, 1});
  messages::LocalModel model;
  simulation.write_local_model(tool, model);
  const Vec3 force_N = to_vec3(model.grip.force_world_N), point_m = to_vec3(model.grip.position_world_m);
  EXPECT_LT((force_N - 500.0 * (to_vec3(tool.body_target_world_m) - point_m)).norm(), 1e-9);
  const double torque_Nm = point_m.x() * force_N.z() - point_m.z() * force_N.x();
  EXPECT_NEAR(torque_Nm, 6.0 * simulation.joint(0).angle_rad, 1e-6);
  EXPECT_GT(torque_Nm, 0.1);
  EXPECT_LT(to_vec3(model.grip.velocity_world_m_s).norm(), 1e-6);
}

TEST(Simulation, SurvivesJumpsAndNonsense) {
  const anatomy::Specimen specimen = testing::coarse_antagonist_hinge();
  Simulation simulation(specimen, {});
  simulation.set_excitation(0, 1.0);
  simulation.set_excitation(1, std::nan(""));
  ToolState yank = press_tool(0, 0, Vec3(0.0, 0.3, 0.3), 5e3);
  yank.grabbed_line = 1;
  yank.grab_fraction = 0.5;
  yank.line_stiffness_N_m = 2e3;
  ToolState nonsense = press_tool(99, -5, Vec3(std::nan(""), 1e300, 0.0), -1.0);
  nonsense.grabbed_line = 77;
  yank.grabbed_body = 1;
  yank.body_point_rest_m = {0.2, 0.0, 0.0};
  yank.body_target_world_m = {0.0, 0.1, 0.3};
  yank.body_stiffness_N_m = 1e5;
  nonsense.grabbed_body = -7;
  nonsense.body_point_rest_m[1] = std::nan("");
  for (int i = 0; i < 8; ++i) {
    simulation.step(i % 4 < 2 ? std::span<const ToolState>(&yank, 1) : std::span<const ToolState>(&nonsense, 1));
    EXPECT_TRUE(std::isfinite(simulation.joint(0).angle_rad));
    for (const Vec3& p : simulation.skin_world_m(0)) ASSERT_TRUE(p.allFinite());
  }
  EXPECT_FALSE(simulation.settle({}, {}));
}

TEST(Simulation, ARigidMuscleFollowsTheBonesAndExertsNothing) {
  const anatomy::Specimen specimen = testing::coarse_antagonist_hinge();
  SimulationSettings settings;
  settings.tissue = {TissueModel::Rigid, TissueModel::Rigid};
  Simulation simulation(specimen, settings);
  const double q = 0.3;
  ASSERT_TRUE(simulation.settle({&q, 1}, {}));
  EXPECT_EQ(simulation.joint(0).net_torque_Nm, 0.0);
  EXPECT_GT((simulation.skin_world_m(0)[0] - specimen.muscles[0].skin.positions_m[0]).norm() +
                (simulation.skin_world_m(0).back() - specimen.muscles[0].skin.positions_m.back()).norm(),
            1e-3);
}

TEST(Simulation, RefusesSettingsThatCannotWork) {
  const anatomy::Specimen specimen = testing::coarse_antagonist_hinge();
  SimulationSettings settings;
  settings.dt_s = 0.0;
  EXPECT_THROW(Simulation(specimen, settings), Error);
  settings = {};
  settings.tissue = {TissueModel::Fem};
  EXPECT_THROW(Simulation(specimen, settings), Error);
}

TEST(Simulation, WritesAFrameOfTheWholeScene) {
  const anatomy::Specimen specimen = testing::coarse_antagonist_hinge();
  Simulation simulation(specimen, {});
  simulation.step({});
  messages::SceneFrame frame;
  simulation.write_frame(frame);
  EXPECT_EQ(frame.sequence, 1u);
  EXPECT_NEAR(frame.time_s, 0.01, 1e-12);
  ASSERT_EQ(frame.skins_world_m.size(), 2u);
  EXPECT_EQ(frame.skins_world_m[0].size(), specimen.muscles[0].skin.positions_m.size());
  EXPECT_EQ(frame.body_poses.size(), 2u);
  EXPECT_EQ(frame.lines_world_m[1].size(), 2u);
  EXPECT_EQ(frame.joints.size(), 1u);
}

TEST(Simulation, AJointsReadoutIsTheSumOverItsMuscles) {
  const anatomy::Specimen specimen = testing::coarse_antagonist_hinge();
  Simulation simulation(specimen, {});
  const double q = 0.2;
  const std::vector<double> activations = {0.6, 0.3};
  ASSERT_TRUE(simulation.settle({&q, 1}, activations));
  const JointReadout whole = simulation.joint(0);
  MuscleAtJoint sum;
  for (int muscle = 0; muscle < 2; ++muscle) {
    const MuscleAtJoint part = simulation.muscle_at_joint(muscle, 0);
    sum.torque_Nm += part.torque_Nm;
    sum.stiffness_Nm_rad += part.stiffness_Nm_rad;
    sum.line_muscle_Nm_rad += part.line_muscle_Nm_rad;
    sum.line_geometry_Nm_rad += part.line_geometry_Nm_rad;
  }
  EXPECT_NEAR(sum.torque_Nm, whole.net_torque_Nm, 1e-12);
  EXPECT_NEAR(sum.stiffness_Nm_rad + whole.passive_Nm_rad, whole.stiffness_Nm_rad, 1e-12);
  EXPECT_NEAR(sum.line_muscle_Nm_rad, whole.line_muscle_Nm_rad, 1e-12);
  EXPECT_NEAR(sum.line_geometry_Nm_rad, whole.line_geometry_Nm_rad, 1e-12);
  EXPECT_NEAR(whole.own_torque_Nm, -whole.passive_Nm_rad * q, 1e-12);
}

}  // namespace myotact::simulation
