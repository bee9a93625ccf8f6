#include "scene/recording.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include "core/error.h"
#include "core/file.h"
#include "scene/recording_header.h"
#include "support/complaint.h"

namespace myotact::scene {
namespace {

std::filesystem::path temporary_file(const std::string& name) {
  return std::filesystem::temp_directory_path() / ("myotact_" + std::to_string(::getpid()) + "_" + name);
}

StepRecord sample_step(std::uint64_t number) {
  StepRecord step;
  step.excitations = {0.25, 0.5};
  step.joint_torques_Nm = {static_cast<double>(number)};
  step.gravity_m_s2 = {0.0, 0.0, -9.81};
  step.tools.resize(1);
  step.tools[0].sequence = number;
  step.state_hash = 1000 + number;
  return step;
}

std::filesystem::path write_sample(const std::string& name) {
  const auto path = temporary_file(name);
  RecordingWriter writer(path, R"({"seed": 1})");
  writer.add(sample_step(1));
  TickRecord tick;
  tick.device.buttons = 1;
  tick.model_sequence = 7;
  writer.add(0, std::vector<TickRecord>{tick, tick});
  writer.add(sample_step(2));
  writer.close();
  return path;
}

TEST(Recording, ReadsBackWhatWasWritten) {
  const auto path = write_sample("whole.rec");
  const Recording recording = read_recording(path);
  std::filesystem::remove(path);
  EXPECT_TRUE(recording.complete);
  EXPECT_EQ(recording.header_json, R"({"seed": 1})");
  ASSERT_EQ(recording.steps.size(), 2u);
  EXPECT_EQ(recording.steps[1].excitations, (std::vector<double>{0.25, 0.5}));
  EXPECT_EQ(recording.steps[1].joint_torques_Nm, std::vector<double>{2.0});
  EXPECT_EQ(recording.steps[1].tools.at(0).sequence, 2u);
  EXPECT_EQ(recording.steps[1].state_hash, 1002u);
  ASSERT_EQ(recording.tools.at(0).ticks.size(), 2u);
  EXPECT_EQ(recording.tools[0].ticks[0].model_sequence, 7u);
}

/// A chunk as the format has it: length, type, payload, checksum of the last two.
void append_chunk(std::string& bytes, const std::string& type_and_payload) {
  const auto length = static_cast<std::uint32_t>(type_and_payload.size() - sizeof(std::uint32_t));
  const auto* data = reinterpret_cast<const Bytef*>(type_and_payload.data());
  const auto sum = static_cast<std::uint32_t>(crc32(0L, data, static_cast<uInt>(type_and_payload.size())));
  bytes.append(reinterpret_cast<const char*>(&length), sizeof length);
  bytes.append(type_and_payload);
  bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
}

/// Steps were shorter once: no number of tools, and the tool's last member was not there.
TEST(Recording, ReadsStepsOfEarlierVersions) {
  constexpr std::uint32_t kStepOfOne = 2, kStep = 7;
  const auto path = write_sample("earlier.rec");
  const std::string now = read_file(path);
  std::string earlier = now.substr(0, 8);
  for (std::size_t at = 8; at < now.size();) {
    std::uint32_t length = 0, type = 0;
    std::memcpy(&length, now.data() + at, sizeof length);
    std::memcpy(&type, now.data() + at + 4, sizeof type);
    std::string chunk = now.substr(at + 4, 4 + length);
    constexpr std::size_t kNew = sizeof(messages::ToolState::touched_world_m);
    if (type == kStep) {
      constexpr std::size_t kHash = sizeof(std::uint64_t), kCount = sizeof(std::uint32_t);
      chunk.erase(chunk.size() - kHash - kNew, kNew);
      chunk.erase(chunk.size() - kHash - (sizeof(messages::ToolState) - kNew) - kCount, kCount);
      std::memcpy(chunk.data(), &kStepOfOne, sizeof kStepOfOne);
    }
    append_chunk(earlier, chunk);
    at += 12 + length;
  }
  std::ofstream(path, std::ios::binary) << earlier;
  const Recording recording = read_recording(path);
  std::filesystem::remove(path);
  EXPECT_TRUE(recording.complete);
  ASSERT_EQ(recording.steps.size(), 2u);
  EXPECT_EQ(recording.steps[1].tools.at(0).sequence, 2u);
  EXPECT_EQ(recording.steps[1].state_hash, 1002u);
}

TEST(Recording, CutAnywhereIsReadableUpToTheLastWholeChunk) {
  const auto path = write_sample("cut.rec");
  const std::string bytes = read_file(path);
  std::size_t most_steps = 0;
  for (std::size_t length = bytes.size() - 1; length > 40; length -= 7) {
    std::filesystem::resize_file(path, length);
    const Recording recording = read_recording(path);
    EXPECT_FALSE(recording.complete);
    most_steps = std::max(most_steps, recording.steps.size());
  }
  std::filesystem::remove(path);
  EXPECT_EQ(most_steps, 2u);
}

TEST(Recording, MustFitTheSpecimen) {
  Recording recording;
  recording.steps = {sample_step(0), sample_step(1)};
  Scene scene;
  scene.specimen.muscles.resize(2);
  scene.specimen.joints.resize(1);
  scene.tools.resize(1);
  EXPECT_NO_THROW(require_fit(recording, scene, "r"));
  recording.steps[1].excitations.push_back(1.0);
  EXPECT_THAT(testing::complaint(ExitStatus::BadData, [&] { require_fit(recording, scene, "r"); }),
              ::testing::HasSubstr("step 1: is for 3 muscles and 1 joints; the specimen has 2 and 1"));
}

TEST(Recording, MustHoldNumbersThatCanBeSimulated) {
  Recording recording;
  recording.steps = {sample_step(0)};
  recording.steps[0].gravity_m_s2.y() = std::nan("");
  Scene scene;
  scene.specimen.muscles.resize(2);
  scene.specimen.joints.resize(1);
  scene.tools.resize(1);
  EXPECT_THAT(testing::complaint(ExitStatus::BadData, [&] { require_fit(recording, scene, "r"); }),
              ::testing::HasSubstr("step 0: has a gravity of 0 nan -9.81 m/s2"));
}

TEST(Recording, NamesThePlaceOfAChunkThatIsTooShort) {
  std::string bytes = "MYOREC01";
  append_chunk(bytes, std::string("\1\0\0\0", 4) + "{}");
  append_chunk(bytes, std::string("\7\0\0\0\1", 5));
  EXPECT_THAT(testing::complaint(ExitStatus::BadData, [&] { parse_recording(bytes, "r"); }),
              ::testing::HasSubstr("r: byte 22: a chunk is shorter than its content"));
}

TEST(Recording, RefusesAFileThatIsNone) {
  const auto path = temporary_file("none.rec");
  std::ofstream(path) << "t_s,x\n";
  EXPECT_THROW(read_recording(path), Error);
  std::filesystem::remove(path);
  EXPECT_THROW(read_recording(path), Error);
}

}  // namespace
}  // namespace myotact::scene
