#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "net/byte_cursor.h"
#include "net/scene_decoder.h"
#include "net/scene_encoder.h"

// Scenes for clients that join late, miss some of them, or are sent nonsense.

namespace myotact::net {
namespace {

/// Skins of so many vertices along a line, all of them moved: large enough that a delta saves something.
messages::SceneFrame lines_of_vertices(const std::vector<std::size_t>& counts, float moved_m = 0.0f) {
  messages::SceneFrame frame;
  for (std::size_t s = 0; s < counts.size(); ++s) {
    auto& skin = frame.skins_world_m.emplace_back();
    for (std::size_t v = 0; v < counts[s]; ++v) {
      skin.push_back({1e-3f * static_cast<float>(v) + moved_m, 0.1f * static_cast<float>(s) + moved_m, moved_m});
    }
  }
  frame.body_poses.assign(2, {1, 0, 0, static_cast<double>(moved_m), 0, 1, 0, 0, 0, 0, 1, 0});
  return frame;
}

/// Whether the decoder takes all that the client lacks.
bool bring(const EncodedScene& scene, const EncodedScene* shown, SceneDecoder& decoder) {
  const auto frames = frames_to_send(scene, shown, {});
  bool sound = true;
  for (const EncodedFrame* frame : frames) {
    FrameHeader header;
    header.type = frame->type;
    header.flags = frame == frames.back() ? kLastOfScene : std::uint8_t{0};
    sound = decoder.take({header, frame->payload}) && sound;
  }
  return sound && decoder.is_whole();
}

void expect_shown(const messages::SceneFrame& shown, const messages::SceneFrame& meant) {
  constexpr float kWithin_m = 0.51e-5f;  // half of the grid, and the rounding of floats
  ASSERT_EQ(shown.skins_world_m.size(), meant.skins_world_m.size());
  for (std::size_t s = 0; s < meant.skins_world_m.size(); ++s) {
    ASSERT_EQ(shown.skins_world_m[s].size(), meant.skins_world_m[s].size()) << s;
    for (std::size_t v = 0; v < meant.skins_world_m[s].size(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        ASSERT_NEAR(shown.skins_world_m[s][v][axis], meant.skins_world_m[s][v][axis], kWithin_m) << s << " " << v;
      }
    }
  }
  EXPECT_EQ(shown.body_poses, meant.body_poses);
}

std::size_t keys_in(const EncodedScene& scene, const EncodedScene* shown) {
  const auto frames = frames_to_send(scene, shown, {});
  return static_cast<std::size_t>(std::count_if(
      frames.begin(), frames.end(), [](const EncodedFrame* frame) { return frame->type == FrameType::SceneKey; }));
}

TEST(SceneDelta, WhoMissedScenesIsToldWhatItLacks) {
  SceneEncoder encoder;
  std::vector<messages::SceneFrame> meant;
  std::vector<std::shared_ptr<const EncodedScene>> scenes;
  for (const float moved_m : {0.0f, 1e-4f, 2.0f, 2.0001f}) {  // a key, its delta, a new key, its delta
    meant.push_back(lines_of_vertices({300, 200}, moved_m));
    scenes.push_back(encoder.encode(meant.back()));
  }
  EXPECT_EQ(scenes[1]->key, scenes[0]->key);
  EXPECT_NE(scenes[2]->key, scenes[1]->key);
  EXPECT_EQ(scenes[3]->key, scenes[2]->key);
  for (std::size_t last = 0; last < scenes.size(); ++last) {
    SceneDecoder late;
    EXPECT_EQ(keys_in(*scenes[last], nullptr), 2u);
    ASSERT_TRUE(bring(*scenes[last], nullptr, late)) << "who joins at " << last;
    expect_shown(late.frame(), meant[last]);
    for (std::size_t next = last + 1; next < scenes.size(); ++next) {
      SceneDecoder decoder = late;  // which was shown the scenes up to `last`, and none before `next`
      EXPECT_EQ(keys_in(*scenes[next], scenes[last].get()), (last < 2) == (next < 2) ? 0u : 2u);
      ASSERT_TRUE(bring(*scenes[next], scenes[last].get(), decoder)) << last << " to " << next;
      expect_shown(decoder.frame(), meant[next]);
    }
  }
}

TEST(SceneDelta, SkinsThatChangeTheirSizeBeginANewKey) {
  SceneEncoder encoder;
  SceneDecoder decoder;
  std::shared_ptr<const EncodedScene> shown;
  const std::vector<std::vector<std::size_t>> sizes = {{300, 200}, {300, 201}, {200, 301},     {300, 201, 50},
                                                       {300},      {301},      {0, 300, 0, 7}, {300, 200}};
  for (const auto& counts : sizes) {
    const messages::SceneFrame meant = lines_of_vertices(counts);
    const auto scene = encoder.encode(meant);
    EXPECT_TRUE(!shown || scene->key != shown->key);
    ASSERT_TRUE(bring(*scene, shown.get(), decoder));
    expect_shown(decoder.frame(), meant);
    shown = scene;
  }
}

/// By hand, from the table of the format: zigzag makes of 0, -1, 1 ... 0, 1, 2 ...; then seven bits a byte, lowest
/// first.
TEST(SceneDelta, IsWrittenAsTheFormatSays) {
  const std::vector<int> steps = {0, 1, -1, 63, 64, -64, -65, 8191, 8192};
  const Bytes expected = {0x00, 0x02, 0x01, 0x7E, 0x80, 0x01, 0x7F, 0x81, 0x01, 0xFE, 0x7F, 0x80, 0x80, 0x01};
  SceneEncoder encoder;
  messages::SceneFrame frame;
  frame.skins_world_m.emplace_back(200);
  const auto first = encoder.encode(frame);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    frame.skins_world_m[0][i / 3][i % 3] = static_cast<float>(1e-5 * steps[i]);
  }
  const auto next = encoder.encode(frame);
  ASSERT_EQ(next->key, first->key);
  const Bytes& payload = next->deltas[0].payload;
  const Bytes head = {1, 0, 0, 0, 0, 0, 1, 0, 200, 0, 0, 0};  // key 1, skin 0 of 1, 200 vertices
  ASSERT_EQ(payload.size(), head.size() + expected.size() + 3 * 200 - steps.size());
  EXPECT_TRUE(std::equal(head.begin(), head.end(), payload.begin()));
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), payload.begin() + 12));
}

TEST(SceneDelta, AVertexThatIsLostTakesNoOtherAlong) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  SceneEncoder encoder;
  SceneDecoder decoder;
  std::shared_ptr<const EncodedScene> shown;
  for (const float lost : {0.5f, std::nanf(""), kInfinity, 1e30f, -1e30f, 1e30f, -kInfinity, 0.5f}) {
    messages::SceneFrame frame = lines_of_vertices({300});
    const auto meant = frame.skins_world_m[0];
    frame.skins_world_m[0][7][1] = lost;
    const auto scene = encoder.encode(frame);
    EXPECT_TRUE(!shown || scene->key == shown->key) << "one vertex is not worth a key";
    ASSERT_TRUE(bring(*scene, shown.get(), decoder)) << lost;
    shown = scene;
    const auto& read = decoder.frame().skins_world_m[0];
    EXPECT_TRUE(std::isfinite(read[7][1]));
    EXPECT_TRUE(lost != 0.5f || std::abs(read[7][1] - 0.5f) < 1e-5f);
    for (std::size_t v = 0; v < read.size(); ++v) {
      ASSERT_NEAR(read[v][0], meant[v][0], 1e-5f) << lost << " " << v;
      ASSERT_TRUE(v == 7 || std::abs(read[v][1] - meant[v][1]) < 1e-5f) << lost << " " << v;
    }
  }
}

/// What a skin's delta begins with, then the bytes.
Bytes delta_payload(std::uint32_t key, std::uint16_t skin, std::uint16_t skins, std::uint32_t vertices,
                    const Bytes& rest) {
  Bytes payload;
  ByteWriter writer(payload);
  writer.put(key);
  writer.put(skin);
  writer.put(skins);
  writer.put(vertices);
  writer.put_bytes(rest.data(), rest.size());
  return payload;
}

TEST(SceneDelta, ThatDoesNotFitItsKeyIsRefused) {
  SceneEncoder encoder;
  SceneDecoder keyed;
  ASSERT_TRUE(bring(*encoder.encode(lines_of_vertices({2, 1})), nullptr, keyed));
  const auto takes = [&](const Bytes& payload) {
    SceneDecoder decoder = keyed;
    FrameHeader header;
    header.type = FrameType::SceneDelta;
    return decoder.take({header, payload});
  };
  // Of skins so small that no delta saves anything, the second key is the one in use.
  const std::uint32_t key = encoder.encode(lines_of_vertices({2, 1}))->key->number - 1;
  const Bytes two(6, 0), one(3, 0);
  ASSERT_TRUE(takes(delta_payload(key, 0, 2, 2, two)));
  ASSERT_TRUE(takes(delta_payload(key, 1, 2, 1, one)));
  EXPECT_FALSE(takes(delta_payload(key + 1, 0, 2, 2, two))) << "another key";
  EXPECT_FALSE(takes(delta_payload(key, 1, 2, 2, two))) << "vertices of the other skin";
  EXPECT_FALSE(takes(delta_payload(key, 0, 3, 2, two))) << "skins";
  EXPECT_FALSE(takes(delta_payload(key, 2, 2, 2, two))) << "a skin beyond the last";
  EXPECT_FALSE(takes(delta_payload(key, 0, 2, 2, Bytes(5, 0)))) << "a number too few";
  EXPECT_FALSE(takes(delta_payload(key, 0, 2, 2, Bytes(7, 0)))) << "a number too many";
  EXPECT_FALSE(takes(delta_payload(key, 0, 2, 2, {0, 0, 0, 0, 0, 0x80}))) << "a number that is cut";
  EXPECT_FALSE(takes(delta_payload(key, 0, 2, 2, {0, 0, 0, 0, 0, 0x80, 0x80, 0x80, 0x80, 0x80, 0}))) << "too long";
  EXPECT_FALSE(SceneDecoder().take({{FrameType::SceneDelta}, delta_payload(1, 0, 1, 0, {})})) << "no key yet";
}

TEST(SceneDelta, EachClientIsSentWhatItWantsAndNoMore) {
  SceneEncoder encoder;
  const auto scene = encoder.encode(lines_of_vertices({300}));
  const auto types = [&](const Wants& wants) {
    std::vector<FrameType> sent;
    for (const EncodedFrame* frame : frames_to_send(*scene, scene.get(), wants)) sent.push_back(frame->type);
    return sent;
  };
  using Types = std::vector<FrameType>;
  EXPECT_EQ(types({}), (Types{FrameType::SceneDelta, FrameType::BonePoses}));
  EXPECT_EQ(types({.readings = true}), (Types{FrameType::SceneDelta, FrameType::BonePoses, FrameType::Readings}));
  EXPECT_EQ(types({.in_force = true}), (Types{FrameType::SceneDelta, FrameType::BonePoses, FrameType::InForce}));
  EXPECT_EQ(types({.hand = true, .frames = true, .readings = true, .meshes = true, .in_force = true}),
            (Types{FrameType::SceneDelta, FrameType::BonePoses, FrameType::Readings, FrameType::InForce}));
}

}  // namespace
}  // namespace myotact::net
