#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/file.h"
#include "core/json_reader.h"
#include "net/control_state_codec.h"
#include "net/frame_reader.h"
#include "net/local_model_codec.h"
#include "net/scene_decoder.h"
#include "net/scene_encoder.h"
#include "net/tool_state_frames.h"
#include "support/source_folder.h"

// The golden vectors, packed by another program from the tables of the format's description: both ways.

namespace myotact::net {
namespace {

const std::filesystem::path kFolder = std::filesystem::path(source_folder()) / "tests" / "net" / "vectors";

Bytes vector_of(const std::string& name) {
  const std::string text = read_file(kFolder / (name + ".bin"));
  return {text.begin(), text.end()};
}

/// The frame of a vector, read as if it were the next one of a stream. `bytes` outlives it.
Frame frame_of(const Bytes& bytes) {
  Frame frame;
  const auto head = std::span(bytes).first<kHeaderBytes>();
  EXPECT_EQ(parse_header(head, frame.header), WireFault::None);
  frame.payload = std::span(bytes).subspan(kHeaderBytes);
  EXPECT_EQ(frame.header.length, frame.payload.size());
  EXPECT_TRUE(has_right_crc(head, frame.payload));
  return frame;
}

void expect_bytes(const std::string& name, const FrameHeader& header, std::span<const std::uint8_t> payload) {
  const Bytes expected = vector_of(name);
  const HeaderBytes head = header_bytes(header, payload);
  ASSERT_EQ(expected.size(), head.size() + payload.size()) << name;
  EXPECT_TRUE(std::equal(head.begin(), head.end(), expected.begin())) << name;
  EXPECT_TRUE(std::equal(payload.begin(), payload.end(), expected.begin() + kHeaderBytes)) << name;
}

template <typename Message>
void expect_both_ways(const std::string& name) {
  const Bytes bytes = vector_of(name);
  const Frame frame = frame_of(bytes);
  Message message;
  ASSERT_TRUE(decode(frame.payload, message)) << name;
  const SmallFrame again = encode(message);
  EXPECT_EQ(again.type, frame.header.type);
  expect_bytes(name, frame.header, again.payload());
}

TEST(Vectors, SmallFramesBothWays) {
  expect_both_ways<Hello>("hello");
  expect_both_ways<Welcome>("welcome");
  expect_both_ways<ForceAnswer>("force");
  expect_both_ways<Event>("event");
  expect_both_ways<Ping>("ping");
  expect_both_ways<Pong>("pong");
  expect_both_ways<Bye>("bye");
  expect_both_ways<PictureSeen>("picture_seen");
}

TEST(Vectors, AHelloSaysWhatItSays) {
  const Bytes bytes = vector_of("hello");
  Hello hello;
  ASSERT_TRUE(decode(frame_of(bytes).payload, hello));
  EXPECT_EQ(hello.role, Role::Student);
  EXPECT_TRUE(hello.wants.hand && hello.wants.frames);
  EXPECT_FALSE(hello.wants.readings || hello.wants.meshes);
  EXPECT_EQ(hello.hand, HandWish::Right);
  EXPECT_EQ(hello.resume_id, 0x1122334455667788u);
  EXPECT_EQ(to_text(hello.token), "000102030405060708090a0b0c0d0e0f");
  EXPECT_EQ(hello.name, "Zo\xC3\xAB");
}

TEST(Vectors, AToolStateIsThreeFrames) {
  ToolStateJoiner joiner;
  const std::array<std::string, 3> names = {"tool_contact", "tool_grip", "tool_state"};
  for (const std::string& name : names) {
    const Bytes bytes = vector_of(name);
    ASSERT_TRUE(joiner.take(frame_of(bytes))) << name;
  }
  const messages::ToolState& state = joiner.state();
  EXPECT_EQ(state.sequence, 12345678901u);
  EXPECT_EQ(state.time_ns, 987654321u);
  EXPECT_EQ(state.contact.triangle, 77);
  EXPECT_EQ(state.contact.barycentric[2], 0.25);
  EXPECT_EQ(state.contact.stiffness_N_m, 812.5);
  EXPECT_EQ(state.grabbed_line, 2);
  EXPECT_EQ(state.body_stiffness_N_m, 333.25);
  EXPECT_EQ(state.touched_world_m[2], 0.31);
  const ToolStateFrames frames = encode(state);
  ASSERT_EQ(frames.count, 3u);
  for (std::size_t i = 0; i < frames.count; ++i) {
    const Bytes bytes = vector_of(names[i]);
    const FrameHeader header = frame_of(bytes).header;
    EXPECT_EQ(frames.frames[i].flags, header.flags);
    expect_bytes(names[i], header, frames.frames[i].payload());
  }
}

TEST(Vectors, ALocalModelBothWays) {
  const Bytes bytes = vector_of("local_model");
  const Frame frame = frame_of(bytes);
  messages::LocalModel model;
  ASSERT_TRUE(decode(frame.payload, model));
  EXPECT_EQ(model.sequence, 17u);
  EXPECT_EQ(model.published_at_ns, 1'000'000'007u);
  EXPECT_EQ(model.contact.compliance_m_N[8], 8e-3);
  EXPECT_EQ(model.line.tension_N, 41.5);
  EXPECT_EQ(model.joint.stiffness_Nm_rad, 1.25);
  EXPECT_EQ(model.tether.anchor_world_m[1], 0.02);
  EXPECT_EQ(model.current_world_m[2][2], 0.01 * 8 + 0.001);
  EXPECT_EQ(model.triangles[0].tissue.tissue, messages::Tissue::Tendon);
  Bytes again;
  encode(model, again);
  expect_bytes("local_model", frame.header, again);
}

TEST(Vectors, ASceneIsPutTogether) {
  SceneDecoder decoder;
  for (const std::string name : {"scene_key", "scene_delta", "bone_poses"}) {
    const Bytes bytes = vector_of(name);
    ASSERT_TRUE(decoder.take(frame_of(bytes))) << name;
  }
  ASSERT_TRUE(decoder.is_whole());
  const messages::SceneFrame& scene = decoder.frame();
  EXPECT_EQ(scene.time_s, 1.25);
  EXPECT_EQ(scene.body_poses[0][11], 0.3);
  const std::array<int, 6> grid = {10'000, 19'999, 30'064, 95, -8192, 4};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_FLOAT_EQ(scene.skins_world_m[0][i / 3][i % 3], static_cast<float>(kGrid_m * grid[i])) << i;
  }
}

TEST(Vectors, WhatIsInForceBothWays) {
  const Bytes bytes = vector_of("in_force");
  const Frame frame = frame_of(bytes);
  messages::ControlState state;
  ASSERT_TRUE(decode_control_state(frame.payload, state));
  EXPECT_EQ(state.drive, messages::Drive::Balance);
  EXPECT_EQ(state.driver, messages::Commander::Network);
  EXPECT_EQ(state.extensors, 0.25);
  EXPECT_EQ(state.difference, -0.125);
  EXPECT_EQ(state.common_now, 0.625);
  EXPECT_TRUE(state.hold_posture && state.paused);
  EXPECT_FALSE(state.gravity || state.recording);
  Bytes again;
  encode_control_state(state, again);
  expect_bytes("in_force", frame.header, again);
}

TEST(Vectors, WhatIsInForceIsRefusedOutOfItsRange) {
  const Bytes bytes = vector_of("in_force");
  const messages::ControlState before;
  for (const auto& [place, byte] :
       {std::pair<std::size_t, std::uint8_t>{0, 3}, {1, 4}, {2, 16}, {10, 0x7F}, {10, 0xBF}}) {
    Bytes payload(bytes.begin() + kHeaderBytes, bytes.end());
    payload[place] = byte;
    messages::ControlState state = before;
    EXPECT_FALSE(decode_control_state(payload, state)) << place;
    EXPECT_EQ(state, before);
  }
  messages::ControlState state;
  EXPECT_FALSE(decode_control_state(std::span(bytes).subspan(kHeaderBytes + 1), state));
}

TEST(Vectors, TheManifestTellsTheirBytes) {
  const nlohmann::json manifest = read_json(kFolder / "manifest.json");
  EXPECT_EQ(manifest.size(), 19u);
  for (const auto& entry : manifest) {
    std::string hex;
    const std::string name = entry.at("file").get<std::string>();
    for (const std::uint8_t byte : vector_of(name.substr(0, name.size() - 4))) {
      constexpr const char* kDigits = "0123456789abcdef";
      hex += {kDigits[byte >> 4], kDigits[byte & 15]};
    }
    EXPECT_EQ(hex, entry.at("hex").get<std::string>()) << name;
  }
}

}  // namespace
}  // namespace myotact::net
