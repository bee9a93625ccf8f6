// A person chooses another tool while the scene runs: what the hand gets, what frames state, and that a recording of it
// is felt again.

#include "scene/tool_choice.h"

#include <chrono>
#include <functional>
#include <thread>

#include <gtest/gtest.h>

#include "device/simulated_device.h"
#include "scene/force_replay.h"
#include "scene/free_session.h"
#include "scene/recording_header.h"
#include "support/synthetic_specimen.h"
#include "support/temporary_folder.h"

namespace myotact::scene {
namespace {

using namespace std::chrono_literals;
using messages::ToolShape;

Scene pressed_flexor(haptics::ForceMethod method) {
  Scene scene;
  scene.name = "pressed flexor";
  scene.specimen = testing::coarse_antagonist_hinge();
  scene.joints.resize(1);
  scene.activations.assign(2, 0.0);
  scene.specimen_folder = ".";
  scene.tools.resize(1);
  scene.tools[0].method = method;
  scene.script.push_back({0.0, 0.5, TouchMuscle{0, 0.5, Vec3::UnitZ(), 4e-3}, 0});
  return scene;
}

TEST(ToolChoice, TheScenesOwnToolIsAsLargeAsTheSceneSays) {
  ToolSettings tool;
  tool.shape = ToolShape::Clamp;
  tool.radius_m = 6e-3;
  EXPECT_EQ(tool_in_hand(tool, std::nullopt), (messages::HeldTool{ToolShape::Clamp, 6e-3}));
  EXPECT_EQ(tool_in_hand(tool, ToolShape::Clamp), (messages::HeldTool{ToolShape::Clamp, 6e-3}));
  EXPECT_EQ(tool_in_hand(tool, ToolShape::Point), (messages::HeldTool{ToolShape::Point, kPointRadius_m}));
  EXPECT_EQ(tool_in_hand(tool, ToolShape::Ball), (messages::HeldTool{ToolShape::Ball, ToolSettings{}.radius_m}));
}

bool comes_true(FreeSession& session, messages::SceneFrame& frame, const std::function<bool()>& condition) {
  for (int i = 0; i < 2000; ++i) {
    if (session.fetch_frame(frame) && condition()) return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

void press_with_other_tools(const Scene& scene, const std::filesystem::path& file) {
  simulation::Simulation simulation(scene.specimen, scene.settings);
  RecordingWriter recorder(file, recording_header(scene, 1, {}));
  device::SimulatedDevice hand("simulated", start_of_hand(scene, 0));
  const std::array<ToolDevice, 1> devices = {ToolDevice{&hand, &hand}};
  FreeSession session(scene, simulation, devices, &recorder);
  session.start();
  messages::SceneFrame frame;
  ASSERT_TRUE(comes_true(session, frame, [&] { return frame.tools.at(0).in_contact; }));
  EXPECT_EQ(frame.tools[0].shape, ToolShape::Ball);
  EXPECT_FALSE(frame.control.tools[0]);
  ASSERT_EQ(session.push({messages::ChooseTool{7, ToolShape::Clamp}}), "");  // no hand has that one
  for (const ToolShape shape : {ToolShape::Point, ToolShape::Clamp}) {
    ASSERT_EQ(session.push({messages::ChooseTool{0, shape}}), "");
    EXPECT_TRUE(comes_true(session, frame, [&] { return frame.tools[0].shape == shape; }));
    EXPECT_EQ(frame.control.tools[0], shape);
    EXPECT_EQ(frame.tools[0].radius_m, tool_in_hand(scene.tools[0], shape).radius_m);
    std::this_thread::sleep_for(300ms);
  }
  ASSERT_EQ(session.push({messages::Reset{}}), "");
  std::this_thread::sleep_for(100ms);
  EXPECT_TRUE(comes_true(session, frame, [&] { return frame.sequence > 0; }));
  EXPECT_EQ(frame.tools[0].shape, ToolShape::Clamp) << "what a person set stays";
  session.stop();
}

TEST(ToolChoice, IsSeenAndARecordingOfItIsFeltAgainToTheLastBit) {
  for (const auto method : {haptics::ForceMethod::Proxy, haptics::ForceMethod::Plane}) {
    const testing::TemporaryFolder folder;
    const Scene scene = pressed_flexor(method);
    press_with_other_tools(scene, folder.path() / "choice.myorec");
    const Recording recording = read_recording(folder.path() / "choice.myorec");
    std::size_t points = 0;
    for (const TickRecord& tick : recording.tools.at(0).ticks) points += tick.chosen == ToolShape::Point;
    EXPECT_GT(points, 100u);

    simulation::Simulation simulation(scene.specimen, scene.settings);
    Conductor start(scene, simulation);
    ForceReplay replay(scene, recording, {});
    replay.feel(simulation);
    // Not the reset: a replay begins anew where the recording does, and knows no other start.
    bool same = true;
    for (std::size_t step = 0; step < recording.steps.size() && same; ++step) {
      apply(recording.steps[step], simulation);
      simulation.step(recording.steps[step].tools);
      same = simulation.state_hash() == recording.steps[step].state_hash;
      if (same) replay.feel(simulation);
    }
    EXPECT_GT(replay.comparison().compared, 50u);
    EXPECT_EQ(replay.comparison().largest_difference_N, 0.0);
    EXPECT_GT(replay.comparison().largest_force_N, 0.05);
  }
}

}  // namespace
}  // namespace myotact::scene
