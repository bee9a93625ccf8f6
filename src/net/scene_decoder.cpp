#include "net/scene_decoder.h"

#include <cmath>

#include "net/byte_cursor.h"
#include "net/control_state_codec.h"
#include "net/readings_codec.h"
#include "net/scene_encoder.h"
#include "net/varint.h"

namespace myotact::net {

namespace {

constexpr std::uint16_t kMostSkins = 256;
constexpr std::size_t kMostVertices = 1'000'000;  // of all skins: ten times the finest limb, 24 MB

/// What key and delta frames of a skin begin with.
struct SkinHead {
  std::uint32_t key = 0;
  std::uint16_t skin = 0, skins = 0;
  std::uint32_t vertices = 0;
};

/// `least`: bytes of a vertex.
bool get_head(ByteReader& in, std::size_t least, SkinHead& head) {
  in.get(head.key);
  in.get(head.skin);
  in.get(head.skins);
  in.get(head.vertices);
  return in.ok() && head.skin < head.skins && head.skins <= kMostSkins && head.vertices <= in.left() / least;
}

}  // namespace

bool SceneDecoder::take(const Frame& frame) {
  whole_ = (frame.header.flags & kLastOfScene) != 0;
  switch (frame.header.type) {
    case FrameType::SceneKey:
      return take_key(frame.payload);
    case FrameType::SceneDelta:
      return take_delta(frame.payload);
    case FrameType::BonePoses:
      return take_poses(frame.payload);
    case FrameType::Readings:
      return decode_readings(frame.payload, frame_);
    case FrameType::InForce:
      return decode_control_state(frame.payload, frame_.control);
    default:
      return false;
  }
}

bool SceneDecoder::take_key(std::span<const std::uint8_t> payload) {
  ByteReader in(payload);
  SkinHead head;
  if (!get_head(in, 3 * sizeof(std::int32_t), head)) return false;
  keys_.resize(head.skins);
  KeySkin& skin = keys_[head.skin];
  skin.places.clear();
  std::size_t vertices = head.vertices;
  for (const KeySkin& other : keys_) vertices += other.places.size();
  if (vertices > kMostVertices) return false;
  skin.key = head.key;
  skin.places.resize(head.vertices);
  for (auto& place : skin.places) in.get(place);
  return in.done();
}

bool SceneDecoder::take_delta(std::span<const std::uint8_t> payload) {
  ByteReader in(payload);
  SkinHead head;
  if (!get_head(in, 3, head) || head.skins != keys_.size()) return false;
  const KeySkin& key = keys_[head.skin];
  if (key.key != head.key || key.places.size() != head.vertices) return false;
  frame_.skins_world_m.resize(head.skins);
  auto& skin = frame_.skins_world_m[head.skin];
  skin.resize(head.vertices);
  for (std::size_t v = 0; v < skin.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::int64_t moved = 0;
      if (!get_varint(in, moved)) return false;
      skin[v][axis] = static_cast<float>(kGrid_m * static_cast<double>(key.places[v][axis] + moved));
    }
  }
  return in.done();
}

bool SceneDecoder::take_poses(std::span<const std::uint8_t> payload) {
  ByteReader in(payload);
  std::uint16_t count = 0;
  in.get(frame_.sequence);
  in.get(frame_.time_s);
  in.get(count);
  if (!in.ok() || in.left() != count * sizeof frame_.body_poses[0]) return false;
  frame_.body_poses.resize(count);
  bool finite = std::isfinite(frame_.time_s);
  for (auto& pose : frame_.body_poses) {
    in.get(pose);
    for (const double number : pose) finite = finite && std::isfinite(number);
  }
  return finite && in.done();
}

}  // namespace myotact::net
