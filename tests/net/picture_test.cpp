#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <zlib.h>

#include "core/file.h"
#include "net/byte_cursor.h"
#include "net/picture_encoder.h"
#include "net/readings_codec.h"
#include "net/varint.h"
#include "support/source_folder.h"

namespace myotact::net {
namespace {

using messages::SceneFrame;

/// A viewer of pictures, written after the format's description.
struct Viewer {
  std::uint64_t sequence = 0;
  double time_s = 0.0;
  std::vector<std::vector<std::array<double, 3>>> skins_m;
  std::vector<std::array<float, 12>> poses;
  bool had_readings = false, had_in_force = false;
  SceneFrame readings;

  bool take(std::span<const std::uint8_t> payload) {
    ByteReader head(payload);
    std::uint64_t now = 0, since = 0;
    head.get(now);
    head.get(since);
    if (!head.ok() || (since != 0 && since != sequence)) return false;
    const Bytes inner = inflated(payload.subspan(16));
    ByteReader in(inner);
    std::uint16_t count = 0;
    in.get(time_s);
    in.get(count);
    poses.resize(count);
    for (auto& pose : poses) in.get(pose);
    if (since == 0) skins_m.clear();
    in.get(count);
    for (int i = 0; i < count; ++i) {
      if (!take_skin(in)) return false;
    }
    sequence = now;
    return take_numbers(in);
  }

 private:
  static Bytes inflated(std::span<const std::uint8_t> packed) {
    Bytes bytes(4u << 20);
    uLongf size = bytes.size();
    const int done = uncompress(bytes.data(), &size, packed.data(), static_cast<uLong>(packed.size()));
    bytes.resize(done == Z_OK ? size : 0);
    return bytes;
  }
  bool take_skin(ByteReader& in) {
    std::uint16_t index = 0;
    std::uint32_t vertices = 0;
    in.get(index);
    in.get(vertices);
    if (!in.ok() || vertices > in.left()) return false;
    if (skins_m.size() <= index) skins_m.resize(index + std::size_t{1});
    skins_m[index].resize(vertices);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (auto& place : skins_m[index]) {
        std::int64_t moved = 0;
        if (!get_varint(in, moved)) return false;
        place[axis] += kPictureGrid_m * static_cast<double>(moved);
      }
    }
    return true;
  }
  bool take_numbers(ByteReader& in) {
    std::uint8_t parts = 0;
    in.get(parts);
    const auto part = [&] {
      std::uint32_t size = 0;
      in.get(size);
      return in.take(size);
    };
    had_readings = (parts & 1) != 0;
    had_in_force = (parts & 2) != 0;
    if (had_readings && !decode_readings(part(), readings)) return false;
    if (had_in_force) part();
    return in.done();
  }
};

SceneFrame frame_at(std::uint64_t sequence) {
  SceneFrame frame;
  frame.sequence = sequence;
  frame.time_s = 0.01 * static_cast<double>(sequence);
  frame.body_poses = {{1, 0, 0, 0.1, 0, 1, 0, 0.2, 0, 0, 1, 0.3}};
  const auto way = static_cast<float>(std::sin(0.1 * static_cast<double>(sequence)));
  frame.skins_world_m.resize(2);
  for (int v = 0; v < 500; ++v) {
    const auto x = static_cast<float>(0.001 * v);
    frame.skins_world_m[0].push_back({x, 0.2f + 0.01f * way, -x});
    frame.skins_world_m[1].push_back({-x, 0.1f, x});  // rests
  }
  frame.activations = {0.123456789};
  return frame;
}

double error_m(const Viewer& viewer, const SceneFrame& frame) {
  double largest = viewer.skins_m.size() == frame.skins_world_m.size() ? 0.0 : 1.0;
  for (std::size_t s = 0; s < viewer.skins_m.size(); ++s) {
    for (std::size_t v = 0; v < frame.skins_world_m[s].size(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        largest = std::max(largest, std::abs(viewer.skins_m[s][v][axis] - double{frame.skins_world_m[s][v][axis]}));
      }
    }
  }
  return largest;
}

TEST(Picture, EveryViewerSeesEveryPictureItGetsToHalfAGridWidth) {
  PictureEncoder encoder;
  Viewer quick, slow;
  std::shared_ptr<const ScenePicture> quick_saw, slow_saw;
  for (std::uint64_t i = 1; i <= 60; ++i) {
    const SceneFrame frame = frame_at(3 * i);
    const auto picture = encoder.encode(frame);
    ASSERT_TRUE(quick.take(picture_payload(*picture, quick_saw.get()))) << i;
    quick_saw = picture;
    EXPECT_LE(error_m(quick, frame), 0.501 * kPictureGrid_m) << i;
    EXPECT_EQ(quick.time_s, frame.time_s);
    if (i % 7 != 0) continue;  // has no room for the others
    ASSERT_TRUE(slow.take(picture_payload(*picture, slow_saw.get()))) << i;
    slow_saw = picture;
    EXPECT_LE(error_m(slow, frame), 0.501 * kPictureGrid_m) << i;
    EXPECT_TRUE(slow.had_readings) << "older than those it has";
  }
}

TEST(Picture, WhatRestsCostsNothing) {
  PictureEncoder encoder;
  SceneFrame frame = frame_at(1);
  const auto first = encoder.encode(frame);
  frame.sequence = 2;
  const auto second = encoder.encode(frame);
  EXPECT_GT(picture_payload(*first, nullptr).size(), 1000u);
  EXPECT_LT(picture_payload(*second, first.get()).size(), 100u);
}

TEST(Picture, ReadingsComeFiveTimesASecondAndInForceWhenItChanges) {
  PictureEncoder encoder;
  Viewer viewer;
  std::shared_ptr<const ScenePicture> saw;
  int readings = 0, in_force = 0;
  for (std::uint64_t i = 1; i <= 30; ++i) {
    SceneFrame frame = frame_at(i);
    frame.control.paused = i >= 20;
    const auto picture = encoder.encode(frame);
    ASSERT_TRUE(viewer.take(picture_payload(*picture, saw.get())));
    saw = picture;
    readings += viewer.had_readings ? 1 : 0;
    in_force += viewer.had_in_force ? 1 : 0;
  }
  EXPECT_EQ(readings, 5);
  EXPECT_EQ(in_force, 2);
  EXPECT_NEAR(viewer.readings.activations.at(0), 0.123456789, 1e-6) << "six digits";
}

TEST(Picture, AnotherNumberOfVerticesIsAWholePicture) {
  PictureEncoder encoder;
  Viewer viewer;
  const auto first = encoder.encode(frame_at(1));
  ASSERT_TRUE(viewer.take(picture_payload(*first, nullptr)));
  SceneFrame other = frame_at(2);
  other.skins_world_m[0].pop_back();
  const auto second = encoder.encode(other);
  ASSERT_TRUE(viewer.take(picture_payload(*second, first.get())));
  EXPECT_LE(error_m(viewer, other), 0.501 * kPictureGrid_m);
}

TEST(Picture, TheVectorsSayWhatTheManifestSays) {
  Viewer viewer;
  for (const char* name : {"picture", "picture_change"}) {
    const auto file =
        std::filesystem::path(source_folder()) / "tests" / "net" / "vectors" / (std::string(name) + ".bin");
    const std::string text = read_file(file);
    const Bytes bytes(text.begin() + kHeaderBytes, text.end());
    ASSERT_TRUE(viewer.take(bytes)) << name;
  }
  EXPECT_EQ(viewer.sequence, 8u);
  EXPECT_NEAR(viewer.skins_m[0][0][1], 0.1968, 1e-12);
  EXPECT_NEAR(viewer.skins_m[0][1][0], 0.0, 1e-12);
}

}  // namespace
}  // namespace myotact::net
