// What the simulation tells of a surface that a hand comes near to.

#include <gtest/gtest.h>

#include "simulation/simulation.h"
#include "support/skin_places.h"
#include "support/synthetic_specimen.h"

namespace myotact::simulation {
namespace {

using messages::ToolState;

// What is told of a place before a tool touches it is what the touch then finds.
TEST(SpringsAhead, ASurfaceNextToAHandTellsItsComplianceBeforeTheTouch) {
  const anatomy::Specimen specimen = testing::coarse_antagonist_hinge();
  Simulation simulation(specimen, {});
  simulation.set_joint_locked(0, true);
  const double q = 0.0;
  ASSERT_TRUE(simulation.settle({&q, 1}, {}));
  const int triangle = testing::skin_triangle_near(simulation, specimen, 0, Vec3(-0.03, 0.0, 1.0));
  const Vec3 place = testing::skin_centre_m(simulation, specimen, 0, triangle);
  const auto told = [&](const ToolState& tool) {
    simulation.step({&tool, 1});
    messages::LocalModel model;
    simulation.write_local_model(tool, model);
    return model.contact;
  };
  ToolState hand;
  hand.sequence = 1;
  hand.proxy_position_world_m = to_array(place + Vec3(0.0, 0.0, 0.005));
  told(hand);  // the first step is of first order in time
  const messages::LocalContact ahead = told(hand);
  EXPECT_EQ(ahead.surface, 0);
  EXPECT_EQ(to_vec3(ahead.force_world_N).norm(), 0.0);
  const messages::LocalContact touched = told(testing::press_tool(0, triangle, place - Vec3(0.0, 0.0, 1e-5), 100.0));
  EXPECT_NEAR(ahead.compliance_m_N[8], touched.compliance_m_N[8], 0.01 * touched.compliance_m_N[8]);
  hand.proxy_position_world_m = to_array(place + Vec3(0.0, 0.0, 0.03));
  EXPECT_EQ(told(hand).surface, -1);
  hand.proxy_position_world_m = to_array(place + Vec3(0.0, 0.0, 0.005));
  hand.sequence = 0;
  EXPECT_EQ(told(hand).surface, -1) << "in no hand";
}

}  // namespace
}  // namespace myotact::simulation
