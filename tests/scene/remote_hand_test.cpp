#include "scene/remote_hand.h"

#include <functional>

#include <gtest/gtest.h>

#include "simulation/simulation.h"
#include "support/synthetic_specimen.h"

namespace myotact::scene {
namespace {

TEST(RemoteHand, IsHeededAsFarAsTheSceneHasWhatItNames) {
  const anatomy::Specimen specimen = testing::antagonist_hinge();
  messages::ToolState sound;
  sound.sequence = 5;
  sound.tool_position_world_m = {0.1, 0.2, 0.3};
  sound.contact.surface = static_cast<int>(specimen.muscles.size() + specimen.bones.size()) - 1;
  sound.contact.stiffness_N_m = 500.0;
  sound.grabbed_line = static_cast<int>(specimen.muscles.size()) - 1;
  sound.grabbed_body = static_cast<int>(specimen.bodies.size()) - 1;
  EXPECT_EQ(heeded(sound, specimen).contact.surface, sound.contact.surface);
  using Break = std::function<void(messages::ToolState&)>;
  for (const Break& break_it : {Break([](auto& s) { ++s.contact.surface; }), Break([](auto& s) { ++s.grabbed_line; }),
                                Break([](auto& s) { ++s.grabbed_body; }), Break([](auto& s) { s.sequence = 0; }),
                                Break([](auto& s) { s.grabbed_body = 1 << 30; })}) {
    messages::ToolState broken = sound;
    break_it(broken);
    const messages::ToolState state = heeded(broken, specimen);
    EXPECT_EQ(state.sequence, 0u);
    EXPECT_EQ(state.contact.surface, -1);
    EXPECT_EQ(state.contact.stiffness_N_m, 0.0);
    EXPECT_EQ(state.grabbed_line, -1);
    EXPECT_EQ(state.grabbed_body, -1);
    EXPECT_EQ(state.tool_position_world_m, sound.tool_position_world_m);
  }
}

TEST(RemoteHand, NobodysHandFeelsNothing) {
  messages::LocalModel model;
  model.tether.stiffness_N_m = 30.0;
  messages::ToolState state;
  state.tool_position_world_m = {0.1, 0.0, 0.0};
  EXPECT_EQ(force_on_hand_N(model, state)[0], 0.0);
  state.sequence = 1;
  EXPECT_DOUBLE_EQ(force_on_hand_N(model, state)[0], -3.0);
}

/// Numbers that the wire lets pass and that no hand has.
TEST(RemoteHand, PullsNoHarderThanAHandCould) {
  const anatomy::Specimen specimen = testing::antagonist_hinge();
  simulation::Simulation simulation(specimen, {});
  messages::ToolState state;
  state.sequence = 1;
  state.grabbed_body = static_cast<int>(specimen.bodies.size()) - 1;
  state.body_stiffness_N_m = 1e6;
  state.body_target_world_m = {9.0, 0.0, 0.0};
  messages::LocalModel model;
  for (int i = 0; i < 20; ++i) {
    simulation.step(std::span(&state, 1));
    simulation.write_local_model(state, model, 0);
    EXPECT_LE(to_vec3(model.grip.force_world_N).norm(), 200.0 * (1.0 + 1e-9));
  }
  EXPECT_GT(to_vec3(model.grip.force_world_N).norm(), 10.0);
}

}  // namespace
}  // namespace myotact::scene
