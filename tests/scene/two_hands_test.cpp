// Two tools in one session: the left hand takes the rod's end and holds it, the right one presses the flexor.

#include <bit>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include "core/error.h"
#include "core/file.h"
#include "scene/conductor.h"
#include "scene/force_replay.h"
#include "scene/free_session.h"
#include "scene/lockstep_session.h"
#include "scene/recording.h"
#include "support/complaint.h"
#include "support/synthetic_specimen.h"

namespace myotact::scene {
namespace {

using ::testing::HasSubstr;

constexpr int kSteps = 150;

Scene held_rod(int workers) {
  Scene scene;
  scene.name = "held rod";
  scene.specimen = testing::coarse_antagonist_hinge();
  scene.settings.workers = workers;
  scene.joints.resize(1);
  scene.activations.assign(2, 0.0);
  scene.tools.resize(2);
  scene.tools[1].hand = "left";
  scene.tools[1].shape = messages::ToolShape::Clamp;
  for (ToolSettings& tool : scene.tools) tool.force_limit = 1.0;
  scene.script.push_back({0.0, 0.9, GrabBone{1, Vec3::UnitX(), Vec3::Zero()}, 1});
  scene.script.push_back({0.1, 0.9, TouchMuscle{0, 0.5, Vec3::UnitZ(), 4e-3}, 0});
  scene.script.push_back({1.2, 0.2, ReleaseHand{}, 0});
  return scene;
}

struct Outcome {
  std::string table;
  std::uint64_t hash = 0;
  int held_steps = 0, pressed_steps = 0;
};

Outcome play(const Scene& scene, RecordingWriter* recorder = nullptr) {
  simulation::Simulation simulation(scene.specimen, scene.settings);
  SampleTable samples(scene.specimen, hands_of(scene), 1);
  LockstepSession session(scene, simulation, samples, recorder);
  Outcome outcome;
  for (int step = 0; step < kSteps; ++step) {
    session.step();
    outcome.held_steps += scene.tools.size() > 1 && session.tool(1).grabbed_body == 1;
    outcome.pressed_steps += session.tool(0).contact.surface == 0;
    EXPECT_EQ(session.tool(0).grabbed_body, -1);
  }
  outcome.table = samples.csv();
  outcome.hash = simulation.state_hash();
  return outcome;
}

std::filesystem::path temporary_file(const std::string& name) {
  return std::filesystem::temp_directory_path() / ("myotact_hands_" + std::to_string(::getpid()) + "_" + name);
}

Recording record(const Scene& scene) {
  const auto path = temporary_file("two.rec");
  RecordingWriter writer(path, "{}");
  play(scene, &writer);
  writer.close();
  const Recording recording = read_recording(path);
  std::filesystem::remove(path);
  return recording;
}

/// Runs a recording again; every step's state and every tool's forces have to come out.
void expect_same_again(const Scene& scene, const Recording& recording) {
  simulation::Simulation simulation(scene.specimen, scene.settings);
  const Conductor start(scene, simulation);
  ForceReplay hands(scene, recording, {});
  hands.feel(simulation);
  for (std::size_t i = 0; i < recording.steps.size(); ++i) {
    apply(recording.steps[i], simulation);
    simulation.step(recording.steps[i].tools);
    ASSERT_EQ(simulation.state_hash(), recording.steps[i].state_hash) << "step " << i;
    hands.feel(simulation);
  }
  ASSERT_EQ(hands.tool_count(), scene.tools.size());
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    EXPECT_EQ(hands.comparison(t).largest_difference_N, 0.0) << t;
    EXPECT_GT(hands.comparison(t).compared, recording.steps.size() / 2) << t;
  }
}

TEST(TwoHands, OneHoldsTheBoneWhileTheOtherPresses) {
  const Outcome outcome = play(held_rod(1));
  EXPECT_GT(outcome.held_steps, 80);
  EXPECT_GT(outcome.pressed_steps, 30);
  EXPECT_THAT(outcome.table, HasSubstr("t_s,right_tool_x_m"));
  EXPECT_THAT(outcome.table, HasSubstr("right_contact,left_tool_x_m"));
  EXPECT_THAT(outcome.table, HasSubstr("left_contact,elbow_q_rad"));
}

TEST(TwoHands, AnyNumberOfWorkersGivesTheSameBits) {
  const Outcome one = play(held_rod(1)), two = play(held_rod(2));
  EXPECT_EQ(one.table, two.table);
  EXPECT_EQ(one.hash, two.hash);
}

TEST(TwoHands, ARecordingGivesEveryToolsForcesAgain) {
  const Scene scene = held_rod(1);
  const Recording recording = record(scene);
  ASSERT_TRUE(recording.complete);
  ASSERT_EQ(recording.tools.size(), 2u);
  for (const ToolRecording& tool : recording.tools) EXPECT_EQ(tool.ticks.size(), 10u * kSteps);
  expect_same_again(scene, recording);
}

TEST(TwoHands, AForceThatDiffersInOneToolIsFound) {
  const Scene scene = held_rod(1);
  Recording recording = record(scene);
  recording.steps[120].tools[1].force_world_N[2] += 1e-6;
  simulation::Simulation simulation(scene.specimen, scene.settings);
  const Conductor start(scene, simulation);
  ForceReplay hands(scene, recording, {});
  hands.feel(simulation);
  for (const StepRecord& step : recording.steps) {
    apply(step, simulation);
    simulation.step(step.tools);
    hands.feel(simulation);
  }
  EXPECT_EQ(hands.comparison(0).largest_difference_N, 0.0);
  EXPECT_NEAR(hands.comparison(1).largest_difference_N, 1e-6, 1e-9);
}

TEST(TwoHands, OnTheWallClockAStopTakesBothForcesAndTheRecordingRunsAgain) {
  const Scene scene = held_rod(1);
  const auto path = temporary_file("free.rec");
  {
    RecordingWriter writer(path, "{}");
    simulation::Simulation simulation(scene.specimen, scene.settings);
    device::SimulatedDevice right("simulated", start_of_hand(scene, 0)), left("simulated", start_of_hand(scene, 1));
    const std::array<ToolDevice, 2> devices = {ToolDevice{&right, &right}, ToolDevice{&left, &left}};
    FreeSession session(scene, simulation, devices, &writer);
    session.start();
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    session.stop_forces(true);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    messages::SceneFrame frame;
    session.fetch_frame(frame);
    ASSERT_EQ(frame.tools.size(), 2u);
    for (const messages::ToolFrame& tool : frame.tools) EXPECT_TRUE(tool.forces_stopped);
    EXPECT_EQ(right.motor_force_N().norm() + left.motor_force_N().norm(), 0.0);
    session.stop();
    const FreeTiming timing = session.timing();
    EXPECT_EQ(timing.tool_ticks.size(), 2u);
    writer.close();
  }
  const Recording recording = read_recording(path);
  std::filesystem::remove(path);
  expect_same_again(scene, recording);
}

/// A chunk as files hold it.
void append_chunk(std::string& file, std::uint32_t type, const std::string& payload) {
  const auto append = [&](std::uint32_t number) { file.append(reinterpret_cast<const char*>(&number), sizeof number); };
  std::string checked(reinterpret_cast<const char*>(&type), sizeof type);
  checked += payload;
  append(static_cast<std::uint32_t>(payload.size()));
  file += checked;
  append(static_cast<std::uint32_t>(
      crc32(0L, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size()))));
}

template <class... Values>
std::string bytes_of(const Values&... values) {
  std::string bytes;
  (bytes.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
  return bytes;
}

// Chunks 2, 5 and 6 of files from before there were two tools, byte by byte.
TEST(TwoHands, ARecordingOfTheFirstVersionHasOneTool) {
  messages::ToolState tool;
  tool.sequence = 10;
  messages::DeviceState device;
  device.buttons = 1;
  const std::array<double, 3> place_m{1.0, 2.0, 3.0};
  std::string file = "MYOREC01";
  append_chunk(file, 1, "{}");
  append_chunk(file, 5, bytes_of(std::uint64_t{7}, std::uint64_t{1'000'000}, std::uint8_t{0}, place_m));
  append_chunk(file, 6, bytes_of(device, std::uint64_t{7}, std::uint64_t{2'000'000}, std::uint8_t{1}));
  append_chunk(
      file, 2,
      bytes_of(std::uint32_t{1}, 0.5, std::uint32_t{1}, 0.25, std::array<double, 3>{}, tool, std::uint64_t{99}));
  append_chunk(file, 4, "");
  const auto path = temporary_file("old.rec");
  std::ofstream(path, std::ios::binary) << file;
  const Recording recording = read_recording(path);
  std::filesystem::remove(path);
  EXPECT_TRUE(recording.complete);
  ASSERT_EQ(recording.tools.size(), 1u);
  ASSERT_EQ(recording.tools[0].ticks.size(), 1u);
  EXPECT_TRUE(recording.tools[0].ticks[0].forces_stopped);
  EXPECT_EQ(recording.tools[0].ticks[0].time_ns, 2'000'000u);
  ASSERT_EQ(recording.tools[0].models.size(), 1u);
  EXPECT_EQ(recording.tools[0].models[0].tool_position_world_m, place_m);
  ASSERT_EQ(recording.steps.size(), 1u);
  ASSERT_EQ(recording.steps[0].tools.size(), 1u);
  EXPECT_EQ(recording.steps[0].tools[0].sequence, 10u);
  EXPECT_EQ(recording.steps[0].state_hash, 99u);
}

TEST(TwoHands, ADamagedNumberOfToolsIsRefused) {
  std::string file = "MYOREC01";
  append_chunk(file, 1, "{}");
  append_chunk(file, 8, bytes_of(std::uint32_t{4'000'000'000}));
  const auto path = temporary_file("bad.rec");
  std::ofstream(path, std::ios::binary) << file;
  EXPECT_THAT(testing::complaint(ExitStatus::BadData, [&] { read_recording(path); }), HasSubstr("another version"));
  std::filesystem::remove(path);
}

TEST(TwoHands, AFullDiskEndsTheRecordingAndNothingElse) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const Scene scene = held_rod(1);
  RecordingWriter writer("/dev/full", "{}");
  simulation::Simulation simulation(scene.specimen, scene.settings);
  device::SimulatedDevice right("simulated", start_of_hand(scene, 0)), left("simulated", start_of_hand(scene, 1));
  const std::array<ToolDevice, 2> devices = {ToolDevice{&right, &right}, ToolDevice{&left, &left}};
  FreeSession session(scene, simulation, devices, &writer);
  session.start();
  EXPECT_TRUE(session.recording());
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  EXPECT_TRUE(session.running());
  EXPECT_FALSE(session.recording());
  messages::SceneFrame frame;
  session.fetch_frame(frame);
  EXPECT_NE(frame.notice.find("free space"), std::string::npos) << frame.notice;
  session.stop();
  EXPECT_GT(session.timing().ticks, 300u);
  EXPECT_NE(session.recording_fault().find("/dev/full"), std::string::npos);
}

}  // namespace
}  // namespace myotact::scene
