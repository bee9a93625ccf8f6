// A recording of a lockstep run is played for a window: the same states come out, no further than the window wants.

#include "scene/replay_session.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.h"
#include "scene/lockstep_session.h"
#include "support/synthetic_specimen.h"

namespace myotact::scene {
namespace {

constexpr int kSteps = 40;

Scene pressed_flexor() {
  Scene scene;
  scene.name = "pressed flexor";
  scene.specimen = testing::coarse_antagonist_hinge();
  scene.joints.resize(1);
  scene.activations.assign(2, 0.0);
  scene.tools.resize(1);
  scene.script.push_back({0.0, 0.3, TouchMuscle{0, 0.5, Vec3::UnitZ(), 4e-3}, 0});
  return scene;
}

/// The newest frame once it stands at that time; what there is after a minute otherwise.
messages::SceneFrame frame_at(ReplaySession& session, double time_s) {
  messages::SceneFrame frame;
  for (int i = 0; i < 6000; ++i) {
    session.fetch_frame(frame);
    if (frame.time_s >= time_s - 1e-9) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return frame;
}

TEST(ReplaySession, ShowsTheRecordedMotionAsFarAsItIsWanted) {
  const auto path = std::filesystem::temp_directory_path() / ("myotact_replay_" + std::to_string(::getpid()));
  LoadedRecording loaded;
  loaded.scene = pressed_flexor();
  messages::SceneFrame half, end;
  {
    simulation::Simulation simulation(loaded.scene.specimen, loaded.scene.settings);
    SampleTable samples(loaded.scene.specimen, hands_of(loaded.scene), 1);
    RecordingWriter writer(path, "{}");
    LockstepSession live(loaded.scene, simulation, samples, &writer);
    for (int step = 1; step <= kSteps; ++step) {
      live.step();
      if (step == kSteps / 2) simulation.write_frame(half);
    }
    simulation.write_frame(end);
    writer.close();
  }
  loaded.recording = read_recording(path);
  std::filesystem::remove(path);
  ASSERT_NE(half.skins_world_m, end.skins_world_m);

  ReplaySession session(loaded);
  const double dt_s = loaded.scene.settings.dt_s;
  EXPECT_NEAR(session.length_s(), kSteps * dt_s, 1e-12);
  session.start();
  const double half_s = (kSteps / 2) * dt_s;
  session.play_to(half_s - 0.5 * dt_s);
  EXPECT_EQ(frame_at(session, half_s).skins_world_m, half.skins_world_m);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  messages::SceneFrame none;
  EXPECT_FALSE(session.fetch_frame(none));  // it waits to be wanted
  session.play_to(1e9);                     // past the end
  const messages::SceneFrame last = frame_at(session, session.length_s());
  EXPECT_EQ(last.skins_world_m, end.skins_world_m);
  EXPECT_NEAR(last.time_s, session.length_s(), 1e-9);
  EXPECT_EQ(last.tools.size(), 1u);
  EXPECT_TRUE(session.running());
  session.stop();
}

TEST(ReplaySession, ARecordingWithoutAStepIsRefusedWithARemedy) {
  const auto path = std::filesystem::temp_directory_path() / ("myotact_replay_" + std::to_string(::getpid()));
  RecordingWriter(path, "{}").close();
  EXPECT_THROW(load_recording(path, {}), Error);
  std::ofstream(path) << "something else";
  EXPECT_THROW(load_recording(path, {}), Error);
  std::filesystem::remove(path);
  EXPECT_THROW(load_recording(path, {}), Error);
}

}  // namespace
}  // namespace myotact::scene
