// Two tools at once: what one feels has in it what the other holds and presses, and nothing else of the other.

#include <array>

#include <gtest/gtest.h>

#include "simulation/simulation.h"
#include "support/skin_places.h"
#include "support/synthetic_specimen.h"

namespace myotact::simulation {
namespace {

using messages::ToolState;
using testing::press_tool, testing::skin_centre_m, testing::skin_triangle_near;
using Compliance = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;

constexpr double kRodInertia_kg_m2 = 0.2 * 0.2 * 0.2 / 3.0;  // 0.2 kg, 0.2 m, about its end
constexpr double kHinge_Nm_rad = 6.0;

ToolState hold(const Vec3& rest_m, const Vec3& target_m, double stiffness_N_m) {
  ToolState tool;
  tool.tool_position_world_m = to_array(target_m);
  tool.grabbed_body = 1;
  tool.body_point_rest_m = to_array(rest_m);
  tool.body_target_world_m = to_array(target_m);
  tool.body_stiffness_N_m = stiffness_N_m;
  return tool;
}

struct Pressed {
  Vec3 place_m, force_N;
  Mat3 compliance_m_N;
};

/// One step from rest: tool 0 presses the flexor `depth_m` deep, `others` do what they do.
Pressed press_flexor(double depth_m, const std::vector<ToolState>& others) {
  const anatomy::Specimen specimen = testing::coarse_antagonist_hinge();
  Simulation simulation(specimen, {});
  const double straight = 0.0;
  EXPECT_TRUE(simulation.settle({&straight, 1}, {}));
  const int triangle = skin_triangle_near(simulation, specimen, 0, Vec3(-0.03, 0.0, 0.04));
  const Vec3 start_m = skin_centre_m(simulation, specimen, 0, triangle);
  std::vector<ToolState> tools = {press_tool(0, triangle, start_m - depth_m * Vec3::UnitZ(), 200.0)};
  tools.insert(tools.end(), others.begin(), others.end());
  simulation.step(tools);
  messages::LocalModel model;
  simulation.write_local_model(tools[0], model, 0);
  EXPECT_EQ(model.contact.surface, 0);
  return {skin_centre_m(simulation, specimen, 0, triangle), to_vec3(model.contact.force_world_N),
          Compliance(model.contact.compliance_m_N.data())};
}

/// By how much the told compliance misses what twice the press does, as a share.
double compliance_error(const Mat3& compliance_m_N, const std::vector<ToolState>& others) {
  const Pressed once = press_flexor(1e-4, others), twice = press_flexor(2e-4, others);
  const Vec3 moved_m = twice.place_m - once.place_m;
  return (compliance_m_N * (twice.force_N - once.force_N) - moved_m).norm() / moved_m.norm();
}

TEST(TwoTools, OnOneMuscleEachComplianceHasTheOthersPressInIt) {
  const anatomy::Specimen specimen = testing::coarse_antagonist_hinge();
  const Simulation rest(specimen, {});
  const int beside = skin_triangle_near(rest, specimen, 0, Vec3(-0.045, 0.0, 0.04));
  ASSERT_NE(beside, skin_triangle_near(rest, specimen, 0, Vec3(-0.03, 0.0, 0.04)));
  const ToolState other = press_tool(0, beside, skin_centre_m(rest, specimen, 0, beside), 2000.0);
  const Mat3 alone_m_N = press_flexor(1e-4, {}).compliance_m_N;
  const Mat3 beside_m_N = press_flexor(1e-4, {other}).compliance_m_N;
  EXPECT_LT(compliance_error(alone_m_N, {}), 0.01);
  EXPECT_LT(compliance_error(beside_m_N, {other}), 0.01);
  EXPECT_GT(compliance_error(alone_m_N, {other}), 0.05);  // the other one does matter
}

TEST(TwoTools, AHeldBoneStiffensTheMuscleThatHangsOnIt) {
  const ToolState held = hold({0.2, 0.0, 0.0}, {0.2, 0.0, 0.0}, 1000.0);
  const Mat3 held_m_N = press_flexor(1e-4, {held}).compliance_m_N;
  EXPECT_LT(compliance_error(held_m_N, {held}), 0.01);
  EXPECT_LT(held_m_N(2, 2), press_flexor(1e-4, {}).compliance_m_N(2, 2));
}

TEST(TwoTools, EachIsToldItsOwnForceInAnyOrder) {
  const anatomy::Specimen specimen = testing::coarse_antagonist_hinge();
  Simulation simulation(specimen, {});
  const int top = skin_triangle_near(simulation, specimen, 0, Vec3(-0.03, 0.0, 0.04));
  const int bottom = skin_triangle_near(simulation, specimen, 1, Vec3(-0.03, 0.0, -0.04));
  const std::array<ToolState, 2> tools = {
      press_tool(0, top, skin_centre_m(simulation, specimen, 0, top) - 1e-3 * Vec3::UnitZ(), 200.0),
      press_tool(1, bottom, skin_centre_m(simulation, specimen, 1, bottom) + 2e-3 * Vec3::UnitZ(), 300.0)};
  simulation.step(tools);
  for (int t = 0; t < 2; ++t) {
    messages::LocalModel model;
    const ToolState& tool = tools[static_cast<std::size_t>(t)];
    simulation.write_local_model(tool, model, t);
    EXPECT_EQ(model.contact.surface, tool.contact.surface);
    const Vec3 place_m = skin_centre_m(simulation, specimen, t, tool.contact.triangle);
    const Vec3 force_N = tool.contact.stiffness_N_m * (to_vec3(tool.contact.target_world_m) - place_m);
    EXPECT_LT((to_vec3(model.contact.force_world_N) - force_N).norm(), 1e-9 * force_N.norm());
    simulation.write_local_model(tool, model, 1 - t);  // the other's springs are not this one's
    EXPECT_EQ(model.contact.surface, -1);
  }
}

// A rod on a hinge, held at its end by 500 N/m: the other hand's point at half the way has that in its stiffness.
TEST(TwoTools, OnOneBoneAGripFeelsTheOtherHandsSpring) {
  const anatomy::Specimen specimen = testing::hinged_bones();
  Simulation simulation(specimen, {});
  const Vec3 end_m(0.2, 0.0, 0.0), middle_m(0.1, 0.0, 0.0);
  const std::array<ToolState, 2> tools = {hold(middle_m, middle_m, 100.0), hold(end_m, end_m, 500.0)};
  simulation.step(tools);
  messages::LocalModel model;
  simulation.write_local_model(tools[0], model, 0);
  EXPECT_NEAR(model.grip.stiffness_1_s2[8], (kHinge_Nm_rad + 500.0 * 0.2 * 0.2) / kRodInertia_kg_m2, 1e-6);
  simulation.write_local_model(tools[1], model, 1);
  EXPECT_NEAR(model.grip.stiffness_1_s2[8], (kHinge_Nm_rad + 100.0 * 0.1 * 0.1) / kRodInertia_kg_m2, 1e-6);
}

// Both pull upwards; at rest the hinge supports the sum of their torques, and each is told its own force.
TEST(TwoTools, OnOneBoneTheirTorquesAddUp) {
  const anatomy::Specimen specimen = testing::hinged_bones();
  Simulation simulation(specimen, {});
  const Vec3 end_m(0.2, 0.0, 0.0), middle_m(0.1, 0.0, 0.0);
  const std::array<ToolState, 2> tools = {hold(middle_m, middle_m + 0.01 * Vec3::UnitZ(), 300.0),
                                          hold(end_m, end_m + 0.01 * Vec3::UnitZ(), 400.0)};
  for (int i = 0; i < 300; ++i) simulation.step(tools);
  double torque_Nm = 0.0;
  for (int t = 0; t < 2; ++t) {
    messages::LocalModel model;
    simulation.write_local_model(tools[static_cast<std::size_t>(t)], model, t);
    const Vec3 force_N = to_vec3(model.grip.force_world_N), point_m = to_vec3(model.grip.position_world_m);
    EXPECT_GT(force_N.z(), 0.1);
    torque_Nm += point_m.x() * force_N.z() - point_m.z() * force_N.x();
  }
  EXPECT_NEAR(torque_Nm, kHinge_Nm_rad * simulation.joint(0).angle_rad, 1e-6);
}

// Halfway between two lines, 1 mm nearer to one: a tool that was offered the other one keeps it, whatever a second tool
// was offered.
TEST(TwoTools, EachKeepsTheLineThatItWasOffered) {
  const anatomy::Specimen specimen = testing::coarse_antagonist_hinge();
  Simulation simulation(specimen, {});
  ToolState above, below;
  above.tool_position_world_m = {-0.03, 0.0, 0.01};
  below.tool_position_world_m = {-0.03, 0.0, -0.01};
  simulation.step(std::array<ToolState, 2>{above, below});
  ToolState nearly;  // 0.5 mm nearer to the flexor above
  nearly.tool_position_world_m = {-0.03, 0.0, 0.0005};
  messages::LocalModel model;
  simulation.write_local_model(nearly, model, 0);
  EXPECT_EQ(model.line.muscle, 0);
  simulation.write_local_model(nearly, model, 1);
  EXPECT_EQ(model.line.muscle, 1);
}

// A muscle that only follows its bones pulls at nothing: its line would hide those that do.
TEST(TwoTools, LinesThatPullAtNothingAreNotOffered) {
  SimulationSettings settings;
  settings.tissue = {TissueModel::Rigid, TissueModel::Fem};
  Simulation simulation(testing::coarse_antagonist_hinge(), settings);
  ToolState on_line;
  messages::LocalModel model;
  for (const double z_m : {0.02, -0.02}) {
    on_line.tool_position_world_m = {-0.03, 0.0, z_m};
    simulation.write_local_model(on_line, model, 0);
    EXPECT_EQ(model.line.muscle, z_m > 0.0 ? -1 : 1);
  }
}

}  // namespace
}  // namespace myotact::simulation
