#include "scene/free_session.h"

#include <chrono>
#include <functional>
#include <thread>

#include <gtest/gtest.h>

#include "core/error.h"
#include "device/simulated_device.h"
#include "scene/recording_header.h"
#include "scene/scene_file.h"
#include "support/temporary_folder.h"

namespace myotact::scene {
namespace {

using namespace std::chrono_literals;

Vec3 sum_N(const messages::ForceParts& p) {
  return to_vec3(p.contact) + to_vec3(p.friction) + to_vec3(p.texture) + to_vec3(p.line) + to_vec3(p.bone) +
         to_vec3(p.damping) + to_vec3(p.limits);
}

TEST(FreeSession, WhileItIsPausedTheDrawnToolFollowsTheHand) {
  const Scene scene = load_scene("elbow", {{"tissue.default", "rigid"}});
  simulation::Simulation simulation(scene.specimen, scene.settings);
  const Vec3 start_m = start_of_hand(scene, 0);
  device::SimulatedDevice hand("simulated", start_m);
  const std::array<ToolDevice, 1> devices = {ToolDevice{&hand, nullptr}};
  FreeSession session(scene, simulation, devices, nullptr);
  session.start();
  ASSERT_EQ(session.push({messages::Pause{true}}), "");
  std::this_thread::sleep_for(200ms);
  messages::SceneFrame before, after;
  ASSERT_TRUE(session.fetch_frame(before));
  hand.set_hand_target({to_array(start_m + Vec3(0, 0, 0.02)), {}, 0});
  std::this_thread::sleep_for(500ms);
  ASSERT_TRUE(session.fetch_frame(after));
  session.stop();
  EXPECT_TRUE(after.control.paused);
  EXPECT_EQ(after.time_s, before.time_s);
  const messages::ToolFrame& tool = after.tools[0];
  EXPECT_GT((to_vec3(tool.tool_world_m) - to_vec3(before.tools[0].tool_world_m)).norm(), 0.01);
  EXPECT_LT((sum_N(tool.parts) - to_vec3(tool.force_world_N)).norm(), 1e-9);
  EXPECT_GT(tool.model_age_s, 0.0);
  EXPECT_EQ(tool.force_scale, scene.tools[0].force_scale);
}

struct RefusingClock : device::ServoClock {
  void start(std::function<void(std::uint64_t)>) override { throw Error(ExitStatus::Unavailable, "unplugged"); }
  void stop() noexcept override {}
};

TEST(FreeSession, WithoutItsServoClockNothingRuns) {
  const Scene scene = load_scene("spring");
  simulation::Simulation simulation(scene.specimen, scene.settings);
  device::SimulatedDevice hand("simulated", start_of_hand(scene, 0));
  const std::array<ToolDevice, 1> devices = {ToolDevice{&hand, nullptr}};
  RefusingClock clock;
  FreeSession session(scene, simulation, devices, nullptr, {nullptr, &clock});
  EXPECT_THROW(session.start(), Error);
  EXPECT_FALSE(session.running());
  session.stop();
  EXPECT_EQ(session.timing().steps, 0U);
}

bool comes_true(FreeSession& session, messages::SceneFrame& frame,
                const std::function<bool(const messages::SceneFrame&)>& condition) {
  for (int i = 0; i < 500; ++i) {
    if (session.fetch_frame(frame) && condition(frame)) return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

TEST(FreeSession, EachSingleStepIsMadeAndARecordingEndsWhenAsked) {
  const testing::TemporaryFolder folder;
  const Scene scene = load_scene("plane");
  simulation::Simulation simulation(scene.specimen, scene.settings);
  RecordingWriter recorder(folder.path() / "steps.myorec", recording_header(scene, 1, {}));
  FreeSession session(scene, simulation, {}, &recorder);
  ASSERT_EQ(session.push({messages::Pause{true}}), "");  // before it runs
  session.start();
  messages::SceneFrame frame;
  ASSERT_TRUE(comes_true(session, frame, [](const auto& f) { return f.control.paused; }));
  EXPECT_EQ(frame.time_s, 0.0);
  EXPECT_TRUE(frame.control.recording);
  for (int i = 0; i < 3; ++i) ASSERT_EQ(session.push({messages::SingleStep{}}), "");
  EXPECT_TRUE(comes_true(session, frame, [&](const auto& f) { return f.time_s > 2.5 * scene.settings.dt_s; }));
  std::this_thread::sleep_for(100ms);
  session.fetch_frame(frame);
  EXPECT_NEAR(frame.time_s, 3.0 * scene.settings.dt_s, 1e-9);
  ASSERT_EQ(session.push({messages::EndRecording{}}), "");
  EXPECT_TRUE(comes_true(session, frame, [](const auto& f) { return !f.control.recording; }));
  session.stop();
}

TEST(FreeSession, AFullQueueIsTold) {
  const Scene scene = load_scene("plane");
  simulation::Simulation simulation(scene.specimen, scene.settings);
  FreeSession session(scene, simulation, {}, nullptr);  // nobody empties it before the start
  int taken = 0;
  while (taken < 100'000 && session.push({messages::SingleStep{}}).empty()) ++taken;
  EXPECT_GT(taken, 100);
  EXPECT_LT(taken, 100'000);
}

/// At the pose of the meshes the fibres are as long as their muscle's file says.
TEST(SceneFrame, StretchesAtTheFilePoseAreThoseOfTheFiles) {
  for (const auto& [model, tolerance] : {std::pair("rigid", 1e-9), std::pair("line", 0.02)}) {
    const Scene scene = load_scene("elbow", {{"tissue.default", model}});
    simulation::Simulation simulation(scene.specimen, scene.settings);
    simulation.settle(std::vector<double>(scene.joints.size(), 0.0),
                      std::vector<double>(scene.specimen.muscles.size(), 0.0));
    messages::SceneFrame frame;
    simulation.write_frame(frame);
    ASSERT_EQ(frame.stretches.size(), scene.specimen.muscles.size());
    for (std::size_t m = 0; m < frame.stretches.size(); ++m) {
      EXPECT_NEAR(frame.stretches[m], scene.specimen.muscles[m].rest_stretch, tolerance)
          << model << " " << scene.specimen.muscles[m].key;
    }
  }
}

}  // namespace
}  // namespace myotact::scene
