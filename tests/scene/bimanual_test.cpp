// What the second hand is for: the built-in scene `bimanual` with it, without it, and with the elbow locked.

#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "scene/lockstep_session.h"

namespace myotact::scene {
namespace {

constexpr double kTouched_s = 2.0, kPressed_s = 3.5;  // of the scene's script: the press begins, and is over
constexpr double kRested_s = 6.0;                     // a free elbow swings for a second after the press

struct Press {
  double elbow_rad = 0.0;           // where it stood before the press
  double turned_rad = 0.0;          // by the press
  double felt_stiffness_N_m = 0.0;  // force on the palpating hand over its way, both since the first step on the skin
};

enum class Elbow { Free, Held, Locked };

/// `locked_rad`: where a locked elbow stands.
Press press(Elbow elbow, double locked_rad = 0.0) {
  Scene scene = load_scene("bimanual");
  std::erase_if(scene.script, [](const ScriptAction& action) { return action.start_s > kPressed_s; });
  if (elbow != Elbow::Held) {
    std::erase_if(scene.script, [](const ScriptAction& action) { return moves_hand(action.what) && action.tool == 1; });
  }
  int joint = 0;
  while (scene.specimen.joints[static_cast<std::size_t>(joint)].key != "elbow") ++joint;
  if (elbow == Elbow::Locked) scene.joints[static_cast<std::size_t>(joint)] = {locked_rad, true};
  simulation::Simulation simulation(scene.specimen, scene.settings);
  SampleTable samples(scene.specimen, hands_of(scene), 1000);
  LockstepSession session(scene, simulation, samples, nullptr);
  double before_rad = 0.0;
  bool touched = false;
  Vec3 met_m = Vec3::Zero(), met_N = Vec3::Zero();
  while (simulation.time_s() < kRested_s) {
    session.step();
    const messages::ToolState& hand = session.tool(0);
    if (!touched && hand.contact.surface >= 0) {
      met_m = to_vec3(hand.tool_position_world_m);
      met_N = to_vec3(hand.force_world_N);
    }
    touched = hand.contact.surface >= 0;
    if (simulation.time_s() < kTouched_s) before_rad = simulation.joint(joint).angle_rad;
  }
  const messages::ToolState& hand = session.tool(0);
  EXPECT_GE(hand.contact.surface, 0);
  EXPECT_EQ(session.tool(1).grabbed_body >= 0, elbow == Elbow::Held);
  const double way_m = (to_vec3(hand.tool_position_world_m) - met_m).norm();
  return {before_rad, std::abs(simulation.joint(joint).angle_rad - before_rad),
          (to_vec3(hand.force_world_N) - met_N).norm() / way_m};
}

TEST(Bimanual, TheHandThatHoldsThePawStillsTheJointAndLetsTheMuscleFeelAsItIs) {
  const Press free = press(Elbow::Free), held = press(Elbow::Held);
  const Press locked = press(Elbow::Locked, held.elbow_rad);  // the hand holds it 0.1 mm from where it rests by itself
  std::printf("elbow turned by %.4f deg without, %.4f deg with the other hand; felt %.1f, %.1f, locked %.1f N/m\n",
              free.turned_rad * 57.2958, held.turned_rad * 57.2958, free.felt_stiffness_N_m, held.felt_stiffness_N_m,
              locked.felt_stiffness_N_m);
  EXPECT_LT(held.turned_rad, 0.2 * free.turned_rad);
  EXPECT_GT(free.turned_rad, 1e-3);
  const double missing_free = std::abs(free.felt_stiffness_N_m - locked.felt_stiffness_N_m);
  const double missing_held = std::abs(held.felt_stiffness_N_m - locked.felt_stiffness_N_m);
  EXPECT_LT(missing_held, 0.3 * missing_free);
}

}  // namespace
}  // namespace myotact::scene
