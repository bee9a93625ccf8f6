#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "net/frame_reader.h"
#include "net/local_model_codec.h"
#include "net/scene_decoder.h"
#include "net/scene_encoder.h"
#include "net/tool_state_frames.h"

namespace myotact::net {
namespace {

std::mt19937_64 random_bits(7);

double number() {
  return std::uniform_real_distribution<double>(-3.0, 3.0)(random_bits);
}

template <std::size_t N>
void fill(std::array<double, N>& values) {
  for (double& value : values) value = number();
}

messages::ToolState touching_state() {
  messages::ToolState state;
  state.sequence = 12345678901;
  state.time_ns = 987654321;
  state.model_sequence = 4321;
  fill(state.tool_position_world_m);
  fill(state.proxy_position_world_m);
  fill(state.force_world_N);
  state.contact = {3, 77, {0.25, 0.5, 0.25}, {0.0, 0.6, 0.8}, {0.1, 0.2, 0.3}, 812.5};
  state.buttons = 5;
  state.faults = 9;
  state.grabbed_line = 2;
  state.grabbed_body = 1;
  state.grab_fraction = 0.3;
  state.line_stiffness_N_m = 250.0;
  fill(state.body_point_rest_m);
  fill(state.body_target_world_m);
  state.body_stiffness_N_m = 333.25;
  fill(state.touched_world_m);
  return state;
}

bool join(const ToolStateFrames& frames, std::uint64_t time_ns, ToolStateJoiner& joiner) {
  bool sound = true;
  for (const SmallFrame& frame : frames.used()) {
    FrameHeader header;
    header.type = frame.type;
    header.flags = frame.flags;
    header.time_ns = time_ns;
    sound = joiner.take({header, frame.payload()}) && sound;
  }
  return sound;
}

TEST(Codec, ToolStatesComeThroughBitForBit) {
  messages::ToolState state = touching_state();
  ToolStateJoiner joiner;
  ASSERT_EQ(encode(state).count, 3u);
  ASSERT_TRUE(join(encode(state), state.time_ns, joiner));
  EXPECT_EQ(std::memcmp(&joiner.state(), &state, sizeof state), 0);
  state.contact = {};
  state.touched_world_m = {};
  ASSERT_TRUE(join(encode(state), state.time_ns, joiner));
  EXPECT_EQ(joiner.state().contact.surface, -1) << "the contact of an earlier state must not stay";
  EXPECT_EQ(joiner.state().grabbed_line, 2);
}

messages::ToolContact contact_beside(int place) {
  const double share = 0.1 * place + 1.0 / 3.0;
  return {10 + place, 5 * place, {share, 0.2, 1.0 - share - 0.2}, {0.0, 0.8, 0.6}, {0.3, 0.1, 0.2}, 812.5};
}

TEST(Codec, ContactsBesideTheFirstComeThroughBitForBit) {
  ToolStateJoiner joiner;
  for (std::size_t count = 1; count <= messages::kMaxContactsBeside; ++count) {
    messages::ToolState state = touching_state();
    for (std::size_t i = 0; i < count; ++i) state.beside[i] = contact_beside(static_cast<int>(i));
    ASSERT_EQ(encode(state).count, 3u + count);
    ASSERT_TRUE(join(encode(state), state.time_ns, joiner));
    EXPECT_EQ(std::memcmp(&joiner.state(), &state, sizeof state), 0);
  }
  ASSERT_TRUE(join(encode(touching_state()), 0, joiner));
  EXPECT_EQ(joiner.state().beside[0].stiffness_N_m, 0.0) << "those of an earlier state must not stay";
}

TEST(Codec, RefusesMoreContactsThanThereAreAndOnesOutOfRange) {
  messages::ToolState state = touching_state();
  state.beside[0] = contact_beside(0);
  const ToolStateFrames frames = encode(state);
  FrameHeader header;
  header.type = FrameType::ToolContact;
  header.flags = messages::kMaxContactsBeside + 1;
  ToolStateJoiner joiner;
  EXPECT_FALSE(joiner.take({header, frames.frames[0].payload()}));
  state.beside[0].target_world_m[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(join(encode(state), 0, joiner));
}

TEST(Codec, EveryFrameOfAToolStateFitsIntoTheSmallOnes) {
  const ToolStateFrames frames = encode(touching_state());
  for (const SmallFrame& frame : frames.used()) EXPECT_LE(kHeaderBytes + frame.size, 128u);
}

TEST(Codec, RefusesToolStatesWithNumbersOutOfRange) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  for (const double bad : {kNan, kInf, 1e9}) {
    messages::ToolState position = touching_state(), stiffness = position, target = position, share = position;
    position.tool_position_world_m[1] = bad;
    stiffness.contact.stiffness_N_m = bad;
    target.body_target_world_m[2] = bad;
    share.grab_fraction = bad;
    for (const auto& state : {position, stiffness, target, share}) {
      ToolStateJoiner joiner;
      EXPECT_FALSE(join(encode(state), 0, joiner));
    }
  }
}

TEST(Codec, WhatWasRefusedIsNotPartOfALaterState) {
  messages::ToolState bad = touching_state();
  bad.contact.stiffness_N_m = -1.0;
  ToolStateJoiner joiner;
  const ToolStateFrames frames = encode(bad);
  FrameHeader header;
  header.type = FrameType::ToolContact;
  EXPECT_FALSE(joiner.take({header, frames.frames[0].payload()}));
  header.type = FrameType::ToolState;
  header.flags = kWithContact;
  EXPECT_TRUE(joiner.take({header, frames.frames[2].payload()}));
  EXPECT_EQ(joiner.state().contact.stiffness_N_m, 0.0);
}

messages::LocalModel some_model() {
  messages::LocalModel model;
  model.sequence = 17;
  model.published_at_ns = 1'000'000'007;
  model.dt_ns = 10'000'000;
  model.tool_sequence = 99;
  fill(model.coverage_centre_world_m);
  model.coverage_radius_m = 0.03;
  model.vertex_count = 190;
  model.triangle_count = 250;
  for (int i = 0; i < model.vertex_count; ++i) {
    fill(model.previous_world_m[static_cast<std::size_t>(i)]);
    fill(model.current_world_m[static_cast<std::size_t>(i)]);
  }
  for (int i = 0; i < model.triangle_count; ++i) {
    auto& triangle = model.triangles[static_cast<std::size_t>(i)];
    triangle = {1, i, {i % 190, (i + 1) % 190, (i + 2) % 190}, {messages::Tissue::Tendon, {0.5f, -0.25f}}};
  }
  fill(model.contact.compliance_m_N);
  model.contact.surface = 4;
  fill(model.line.grab_point_world_m);
  model.line.tension_N = 41.5;
  fill(model.grip.mobility_1_kg);
  model.joint.stiffness_Nm_rad = 1.25;
  model.tether = {40.0, {0.1, 0.2, 0.3}, {1.0, 2.0, 3.0}};
  model.reported.count = 2;
  model.reported.contacts[1].penetration_m = 1e-3;
  return model;
}

TEST(Codec, LocalModelsComeThroughBitForBit) {
  const messages::LocalModel model = some_model();
  Bytes bytes;
  encode(model, bytes);
  messages::LocalModel read;
  ASSERT_TRUE(decode(bytes, read));
  Bytes again;
  encode(read, again);
  EXPECT_EQ(bytes, again);
  EXPECT_EQ(read.current_world_m[189], model.current_world_m[189]);
  EXPECT_EQ(read.triangles[249].vertices, model.triangles[249].vertices);
  EXPECT_EQ(read.tether.anchor_world_m, model.tether.anchor_world_m);
  EXPECT_EQ(read.grip.mobility_1_kg, model.grip.mobility_1_kg);
}

TEST(Codec, RefusesLocalModelsThatAreCutOrPointBeyondTheirVertices) {
  Bytes bytes;
  encode(some_model(), bytes);
  messages::LocalModel read;
  for (std::size_t size = 0; size < bytes.size(); size += 97) {
    EXPECT_FALSE(decode(std::span(bytes).first(size), read)) << size;
  }
  messages::LocalModel beyond = some_model();
  beyond.triangles[3].vertices[1] = 191;
  encode(beyond, bytes);
  EXPECT_FALSE(decode(bytes, read));
}

messages::SceneFrame some_scene(float moved_m) {
  messages::SceneFrame frame;
  frame.sequence = 5;
  frame.time_s = 1.25;
  frame.body_poses.resize(3);
  for (auto& pose : frame.body_poses) fill(pose);
  frame.skins_world_m = {{{0.1f, 0.2f, 0.3f + moved_m}, {-0.1f, 0.0f, 0.05f}}, {}, {{1.0f, 2.0f, 3.0f - moved_m}}};
  frame.activations = {0.1, 0.2, 0.3};
  frame.lines_world_m = {{{0.0, 0.1, 0.2}, {0.3, 0.4, 0.5}}, {}, {{1.0, 1.0, 1.0}}};
  frame.springs_world_m = {{{{0.5, 0.6, 0.7}, {0.8, 0.9, 1.0}}}};
  frame.joints.resize(2);
  frame.joints[1].stiffness_Nm_rad = 1.5;
  frame.joints[1].muscles = {{0.1, 0.2, 0.3, 0.4, 0.5}, {}};
  frame.tools.resize(1);
  frame.tools[0].shape = messages::ToolShape::Clamp;
  frame.tools[0].parts.friction = {0.1, 0.2, 0.3};
  frame.notice = "Muskeln ermüden";
  return frame;
}

/// Sends all that a client needs and returns how many bytes it was.
std::size_t send(const EncodedScene& scene, const EncodedScene* shown, SceneDecoder& decoder) {
  std::size_t size = 0;
  const auto frames = frames_to_send(scene, shown, {.readings = true});
  for (const EncodedFrame* frame : frames) {
    FrameHeader header;
    header.type = frame->type;
    header.flags = frame == frames.back() ? kLastOfScene : std::uint8_t{0};
    EXPECT_TRUE(decoder.take({header, frame->payload}));
    EXPECT_EQ(decoder.is_whole(), frame == frames.back());
    size += frame->payload.size();
  }
  return size;
}

TEST(Codec, ScenesComeThroughWithinTheGrid) {
  SceneEncoder encoder;
  SceneDecoder decoder;
  std::shared_ptr<const EncodedScene> shown;
  for (const float moved_m : {0.0f, 1e-4f, 5e-3f, 2.0f}) {  // the last one is worth a new key
    const messages::SceneFrame frame = some_scene(moved_m);
    const auto scene = encoder.encode(frame);
    send(*scene, shown.get(), decoder);
    shown = scene;
    const messages::SceneFrame& read = decoder.frame();
    ASSERT_EQ(read.skins_world_m.size(), 3u);
    for (std::size_t s = 0; s < 3; ++s) {
      ASSERT_EQ(read.skins_world_m[s].size(), frame.skins_world_m[s].size());
      for (std::size_t v = 0; v < read.skins_world_m[s].size(); ++v) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          EXPECT_NEAR(read.skins_world_m[s][v][axis], frame.skins_world_m[s][v][axis], 0.51 * kGrid_m);
        }
      }
    }
    EXPECT_EQ(read.body_poses, frame.body_poses);
    EXPECT_EQ(read.lines_world_m, frame.lines_world_m);
    EXPECT_EQ(read.springs_world_m, frame.springs_world_m);
    EXPECT_EQ(read.joints[1].muscles[0].moment_arm_m, 0.5);
    EXPECT_EQ(read.tools[0].parts.friction, frame.tools[0].parts.friction);
    EXPECT_EQ(read.notice, frame.notice);
  }
}

TEST(Codec, WhatHardlyMovesIsAThirdOfAKeyOrLess) {
  messages::SceneFrame frame;
  frame.skins_world_m.resize(1);
  for (int i = 0; i < 3000; ++i) {
    frame.skins_world_m[0].push_back({static_cast<float>(0.1 * number()), static_cast<float>(0.1 * number()), 0.1f});
  }
  SceneEncoder encoder;
  const auto first = encoder.encode(frame);
  for (auto& vertex : frame.skins_world_m[0]) vertex[2] += 3e-4f;  // a muscle that swells
  const auto next = encoder.encode(frame);
  EXPECT_EQ(next->key, first->key);
  EXPECT_LE(3 * next->deltas[0].payload.size(), first->key->frames[0].payload.size());
}

TEST(FrameReader, RefusesALengthOfFourGigabytesAtTheHeader) {
  FrameHeader header;
  header.type = FrameType::ToolState;
  HeaderBytes bytes = header_bytes(header, {});
  std::memset(bytes.data() + 4, 0xFF, 4);
  FrameReader reader;
  const auto room = reader.room();
  std::copy(bytes.begin(), bytes.end(), room.begin());
  reader.filled(bytes.size());
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.fault(), WireFault::Length);
}

TEST(FrameReader, TellsFramesWhateverPiecesTheyComeIn) {
  Bytes stream;
  Bytes payload(40'000, 0x20);  // spaces: a Control, longer than the reader's first room
  for (std::uint32_t i = 0; i < 5; ++i) {
    FrameHeader header;
    header.type = FrameType::Control;
    header.sequence = i;
    const HeaderBytes bytes = header_bytes(header, payload);
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    stream.insert(stream.end(), payload.begin(), payload.end());
  }
  FrameReader reader;
  std::size_t sent = 0;
  std::uint32_t told = 0;
  while (sent < stream.size()) {
    const auto room = reader.room();
    const std::size_t piece = std::min({room.size(), stream.size() - sent, std::size_t{1} + sent % 1777});
    std::copy_n(stream.begin() + static_cast<std::ptrdiff_t>(sent), piece, room.begin());
    reader.filled(piece);
    sent += piece;
    while (const auto frame = reader.next()) {
      EXPECT_EQ(frame->header.sequence, told++);
      EXPECT_EQ(frame->payload.size(), payload.size());
    }
  }
  EXPECT_EQ(told, 5u);
  EXPECT_EQ(reader.fault(), WireFault::None);
}

TEST(Utf8, IsWhatTheStandardSays) {
  const auto is_text = [](std::initializer_list<int> bytes) {
    Bytes text;
    for (const int byte : bytes) text.push_back(static_cast<std::uint8_t>(byte));
    return is_utf8(text);
  };
  EXPECT_TRUE(is_text({'a', 0xC3, 0xBC, 0xE2, 0x82, 0xAC, 0xF0, 0x9F, 0x90, 0x95}));
  EXPECT_FALSE(is_text({0x80}));
  EXPECT_FALSE(is_text({0xC0, 0xAF}));              // overlong
  EXPECT_FALSE(is_text({0xED, 0xA0, 0x80}));        // surrogate
  EXPECT_FALSE(is_text({0xF4, 0x90, 0x80, 0x80}));  // beyond U+10FFFF
  EXPECT_FALSE(is_text({0xE2, 0x82}));              // cut
  EXPECT_FALSE(is_text({'a', 0, 'b'}));
}

}  // namespace
}  // namespace myotact::net
