#include "net/scene_encoder.h"

#include <algorithm>
#include <cmath>

#include "net/byte_cursor.h"
#include "net/control_state_codec.h"
#include "net/readings_codec.h"
#include "net/varint.h"

namespace myotact::net {

namespace {

using Skin = std::vector<std::array<float, 3>>;
using GridSkin = std::vector<std::array<std::int32_t, 3>>;

constexpr double kFarthest = 2e9;  // grid widths: 20 km, within 32 bits

std::int32_t on_grid(float metres) {
  const double place = std::round(static_cast<double>(metres) / kGrid_m);
  return static_cast<std::int32_t>(std::clamp(std::isfinite(place) ? place : 0.0, -kFarthest, kFarthest));
}

GridSkin on_grid(const Skin& skin) {
  GridSkin grid(skin.size());
  for (std::size_t v = 0; v < skin.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) grid[v][axis] = on_grid(skin[v][axis]);
  }
  return grid;
}

/// What key and delta frames of a skin begin with.
ByteWriter begin_skin(Bytes& out, std::uint32_t key, std::size_t skin, std::size_t skins, std::size_t vertices) {
  ByteWriter writer(out);
  writer.put(key);
  writer.put(static_cast<std::uint16_t>(skin));
  writer.put(static_cast<std::uint16_t>(skins));
  writer.put(static_cast<std::uint32_t>(vertices));
  return writer;
}

std::shared_ptr<const SceneKey> make_key(std::uint32_t number, std::vector<GridSkin> skins) {
  auto key = std::make_shared<SceneKey>();
  key->number = number;
  key->skins = std::move(skins);
  for (std::size_t s = 0; s < key->skins.size(); ++s) {
    EncodedFrame frame{FrameType::SceneKey, {}};
    ByteWriter writer = begin_skin(frame.payload, number, s, key->skins.size(), key->skins[s].size());
    for (const auto& place : key->skins[s]) writer.put(place);
    key->frames.push_back(std::move(frame));
  }
  return key;
}

std::vector<EncodedFrame> deltas_of(const std::vector<GridSkin>& skins, const SceneKey& key) {
  std::vector<EncodedFrame> deltas;
  for (std::size_t s = 0; s < skins.size(); ++s) {
    EncodedFrame frame{FrameType::SceneDelta, {}};
    begin_skin(frame.payload, key.number, s, skins.size(), skins[s].size());
    for (std::size_t v = 0; v < skins[s].size(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        put_varint(frame.payload, std::int64_t{skins[s][v][axis]} - key.skins[s][v][axis]);
      }
    }
    deltas.push_back(std::move(frame));
  }
  return deltas;
}

std::size_t size_of(const std::vector<EncodedFrame>& frames) {
  std::size_t size = 0;
  for (const EncodedFrame& frame : frames) size += frame.payload.size();
  return size;
}

bool have_same_sizes(const std::vector<GridSkin>& a, const std::vector<GridSkin>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const GridSkin& one, const GridSkin& other) { return one.size() == other.size(); });
}

EncodedFrame encode_poses(const messages::SceneFrame& frame) {
  EncodedFrame out{FrameType::BonePoses, {}};
  ByteWriter writer(out.payload);
  writer.put(frame.sequence);
  writer.put(frame.time_s);
  writer.put(static_cast<std::uint16_t>(frame.body_poses.size()));
  for (const auto& pose : frame.body_poses) writer.put(pose);
  return out;
}

}  // namespace

std::vector<const EncodedFrame*> frames_to_send(const EncodedScene& scene, const EncodedScene* shown,
                                                const Wants& wants) {
  std::vector<const EncodedFrame*> frames;
  if (shown == nullptr || shown->key != scene.key) {
    for (const EncodedFrame& frame : scene.key->frames) frames.push_back(&frame);
  }
  for (const EncodedFrame& frame : scene.deltas) frames.push_back(&frame);
  frames.push_back(&scene.poses);
  if (wants.readings) frames.push_back(&scene.readings);
  if (wants.in_force) frames.push_back(&scene.in_force);
  return frames;
}

std::shared_ptr<const EncodedScene> SceneEncoder::encode(const messages::SceneFrame& frame) {
  constexpr double kSaves = 0.4;  // of a key's size: 1.6 bytes a number, motions of some millimetres
  std::vector<GridSkin> skins;
  for (const Skin& skin : frame.skins_world_m) skins.push_back(on_grid(skin));
  if (!key_ || !have_same_sizes(skins, key_->skins)) key_ = make_key(++key_count_, skins);
  auto scene = std::make_shared<EncodedScene>();
  scene->deltas = deltas_of(skins, *key_);
  if (static_cast<double>(size_of(scene->deltas)) > kSaves * static_cast<double>(size_of(key_->frames))) {
    key_ = make_key(++key_count_, skins);
    scene->deltas = deltas_of(skins, *key_);
  }
  scene->key = key_;
  scene->poses = encode_poses(frame);
  scene->readings = {FrameType::Readings, {}};
  encode_readings(frame, scene->readings.payload);
  scene->in_force = {FrameType::InForce, {}};
  encode_control_state(frame.control, scene->in_force.payload);
  return scene;
}

}  // namespace myotact::net
