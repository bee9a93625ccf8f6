// The shipped scenes' own scripts from beginning to end, and with joints free that the scenes lock: presses, strokes
// and full co-contraction fold no point of any muscle over.

#include <algorithm>
#include <cstdio>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "scene/lockstep_session.h"
#include "scene/samples.h"
#include "scene/scene_file.h"

namespace myotact::scene {
namespace {

struct Played {
  std::string scene, free_joint = {};  // that the scene locks
};

std::ostream& operator<<(std::ostream& out, const Played& played) {
  return out << played.scene << played.free_joint;
}

class WholeScript : public ::testing::TestWithParam<Played> {};

TEST_P(WholeScript, NoPointIsPressedBelowAFifthOfItsVolume) {
  const auto& [name, free_joint] = GetParam();
  Overrides changes;
  if (!free_joint.empty()) changes["joints." + free_joint + ".locked"] = "false";
  const Scene scene = load_scene(name, changes);
  ASSERT_FALSE(scene.script.empty());
  simulation::Simulation simulation(scene.specimen, scene.settings);
  SampleTable samples(scene.specimen, hands_of(scene), 1'000'000);
  LockstepSession session(scene, simulation, samples, nullptr);
  double end_s = 0.0;
  for (const ScriptAction& action : scene.script) end_s = std::max(end_s, action.start_s + action.duration_s);
  while (simulation.time_s() < end_s) session.step();
  const Extremes& reached = session.extremes();
  std::printf("smallest J %.3f, volume within %.2f %%\n", reached.smallest_J, 1e2 * reached.volume_error);
  EXPECT_GT(reached.smallest_J, 0.2);
  EXPECT_LT(reached.volume_error, 0.01);
  EXPECT_LT(reached.residual_share, 1.0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, WholeScript,
                         ::testing::Values(Played{"elbow"}, Played{"stifle"}, Played{"hock"}, Played{"forelimb"},
                                           Played{"hindlimb"}, Played{"bimanual"}, Played{"forelimb", "shoulder"},
                                           Played{"forelimb", "carpus"}, Played{"hindlimb", "hip"}),
                         [](const auto& played) { return played.param.scene + played.param.free_joint; });

}  // namespace
}  // namespace myotact::scene
