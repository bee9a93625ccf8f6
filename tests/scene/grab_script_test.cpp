// The script's `grab_bone`: in lockstep bit for bit the same for any number of workers, and again from its recording.

#include <filesystem>

#include <gtest/gtest.h>
#include <unistd.h>

#include "scene/conductor.h"
#include "scene/force_replay.h"
#include "scene/lockstep_session.h"
#include "scene/recording.h"
#include "support/synthetic_specimen.h"

namespace myotact::scene {
namespace {

/// Coarse antagonists on a hinge; the hand takes the lower rod at its end and lifts it by 10 mm against the extensor.
Scene lifted_rod(int workers) {
  Scene scene;
  scene.name = "lifted rod";
  scene.specimen = testing::coarse_antagonist_hinge();
  scene.settings.workers = workers;
  scene.joints.resize(1);
  scene.activations.assign(2, 0.0);
  scene.tools.resize(1);
  scene.tools[0].force_limit = 1.0;
  scene.script.push_back({0.0, 1.4, GrabBone{1, Vec3::UnitX(), Vec3(0.0, 0.0, 0.01)}});
  scene.script.push_back({0.8, 0.2, Activate{1, 0.1}});
  scene.script.push_back({1.4, 0.3, ReleaseHand{}});
  return scene;
}

struct Outcome {
  std::string table;
  std::uint64_t hash = 0;
  double lifted_rad = 0.0;  // at the end of the drag
  int grabbed_steps = 0;
  double largest_force_N = 0.0;
};

Outcome play(int workers, RecordingWriter* recorder = nullptr) {
  const Scene scene = lifted_rod(workers);
  simulation::Simulation simulation(scene.specimen, scene.settings);
  SampleTable samples(scene.specimen, hands_of(scene), 1);
  LockstepSession session(scene, simulation, samples, recorder);
  Outcome outcome;
  for (int step = 0; step < 190; ++step) {
    session.step();
    if (step == 138) outcome.lifted_rad = simulation.joint(0).angle_rad;
    outcome.grabbed_steps += session.tool().grabbed_body == 1;
    outcome.largest_force_N = std::max(outcome.largest_force_N, to_vec3(session.tool().force_world_N).norm());
  }
  EXPECT_EQ(session.tool().grabbed_body, -1);  // let go at the end
  outcome.table = samples.csv();
  outcome.hash = simulation.state_hash();
  return outcome;
}

TEST(GrabScript, TakesTheBoneLiftsItAndLetsGo) {
  const Outcome outcome = play(1);
  EXPECT_NEAR(outcome.grabbed_steps, 77 + 10, 3);  // from 0.63 s to 1.4 s, and 0.1 s of letting go
  EXPECT_GT(outcome.lifted_rad, 0.005);            // the hand yields, the grip yields
  EXPECT_GT(outcome.largest_force_N, 0.5);
}

TEST(GrabScript, AnyNumberOfWorkersGivesTheSameBits) {
  const Outcome one = play(1), two = play(2);
  EXPECT_EQ(one.table, two.table);
  EXPECT_EQ(one.hash, two.hash);
}

TEST(GrabScript, ARecordingRunsAgainToTheSameStatesAndForces) {
  const auto path = std::filesystem::temp_directory_path() / ("myotact_grab_" + std::to_string(::getpid()) + ".rec");
  RecordingWriter writer(path, "{}");
  play(2, &writer);
  writer.close();
  const Recording recording = read_recording(path);
  std::filesystem::remove(path);
  const Scene scene = lifted_rod(1);
  simulation::Simulation simulation(scene.specimen, scene.settings);
  const Conductor start(scene, simulation);
  ForceReplay hand(scene, recording, {});
  ASSERT_EQ(recording.steps.size(), 190u);
  hand.feel(simulation);
  for (std::size_t i = 0; i < recording.steps.size(); ++i) {
    apply(recording.steps[i], simulation);
    simulation.step(recording.steps[i].tools);
    ASSERT_EQ(simulation.state_hash(), recording.steps[i].state_hash) << "step " << i;
    hand.feel(simulation);
    ASSERT_EQ(hand.comparison().largest_difference_N, 0.0) << "step " << i;
  }
  EXPECT_EQ(hand.comparison().compared, recording.steps.size());
  EXPECT_GT(hand.comparison().largest_force_N, 0.5);  // something was felt
}

}  // namespace
}  // namespace myotact::scene
