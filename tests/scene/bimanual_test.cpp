// What the second hand is for: the built-in scene `bimanual` with it, without it, and with the elbow locked.

#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "scene/lockstep_session.h"

namespace myotact::scene {
namespace {

constexpr double kTouched_s = 2.0, kSettled_s = 3.5;  // of the scene's script: the press begins, and rests

struct Press {
  double turned_rad = 0.0;          // of the elbow, by the press
  double felt_stiffness_N_m = 0.0;  // force on the palpating hand over its way since it met the skin
};

enum class Elbow { Free, Held, Locked };

Press press(Elbow elbow) {
  Scene scene = load_scene("bimanual");
  if (elbow != Elbow::Held) {
    std::erase_if(scene.script, [](const ScriptAction& action) { return moves_hand(action.what) && action.tool == 1; });
  }
  for (JointSetting& joint : scene.joints) joint.locked = joint.locked || elbow == Elbow::Locked;
  int joint = 0;
  while (scene.specimen.joints[static_cast<std::size_t>(joint)].key != "elbow") ++joint;
  simulation::Simulation simulation(scene.specimen, scene.settings);
  SampleTable samples(scene.specimen, hands_of(scene), 1000);
  LockstepSession session(scene, simulation, samples, nullptr);
  double before_rad = 0.0;
  Vec3 met_m = Vec3::Constant(std::nan(""));
  while (simulation.time_s() < kSettled_s) {
    session.step();
    const messages::ToolState& hand = session.tool(0);
    if (hand.contact.surface < 0) met_m = to_vec3(hand.tool_position_world_m);
    if (simulation.time_s() < kTouched_s) before_rad = simulation.joint(joint).angle_rad;
  }
  const messages::ToolState& hand = session.tool(0);
  EXPECT_GE(hand.contact.surface, 0);
  EXPECT_EQ(session.tool(1).grabbed_body >= 0, elbow == Elbow::Held);
  const double way_m = (to_vec3(hand.tool_position_world_m) - met_m).norm();
  return {std::abs(simulation.joint(joint).angle_rad - before_rad), to_vec3(hand.force_world_N).norm() / way_m};
}

TEST(Bimanual, TheHandThatHoldsThePawStillsTheJointAndLetsTheMuscleFeelAsItIs) {
  const Press free = press(Elbow::Free), held = press(Elbow::Held), locked = press(Elbow::Locked);
  std::printf("elbow turned by %.4f deg without, %.4f deg with the other hand; felt %.1f, %.1f, locked %.1f N/m\n",
              free.turned_rad * 57.2958, held.turned_rad * 57.2958, free.felt_stiffness_N_m, held.felt_stiffness_N_m,
              locked.felt_stiffness_N_m);
  EXPECT_LT(held.turned_rad, 0.2 * free.turned_rad);
  EXPECT_GT(free.turned_rad, 1e-3);
  const double missing_free = std::abs(free.felt_stiffness_N_m - locked.felt_stiffness_N_m);
  const double missing_held = std::abs(held.felt_stiffness_N_m - locked.felt_stiffness_N_m);
  EXPECT_LT(missing_held, 0.33 * missing_free);
}

}  // namespace
}  // namespace myotact::scene
