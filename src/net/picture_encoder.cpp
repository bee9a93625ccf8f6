#include "net/picture_encoder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include <zlib.h>

#include "core/error.h"
#include "net/byte_cursor.h"
#include "net/control_state_codec.h"
#include "net/readings_codec.h"
#include "net/varint.h"

namespace myotact::net {

namespace {

using GridSkin = std::vector<std::array<std::int32_t, 3>>;

constexpr double kFarthest = 1e9;     // grid widths: 50 km, within 32 bits
constexpr int kPicturesAReading = 6;  // numbers on a screen are read five times a second
constexpr std::uint8_t kWithReadings = 1, kWithInForce = 2;

std::int32_t on_grid(float metres) {
  const double place = std::round(static_cast<double>(metres) / kPictureGrid_m);
  return static_cast<std::int32_t>(std::clamp(std::isfinite(place) ? place : 0.0, -kFarthest, kFarthest));
}

GridSkin on_grid(const std::vector<std::array<float, 3>>& skin) {
  GridSkin grid(skin.size());
  for (std::size_t v = 0; v < skin.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) grid[v][axis] = on_grid(skin[v][axis]);
  }
  return grid;
}

/// The first six digits: what is left out would be half of what is sent, and no screen shows it.
double coarse(double number) {
  constexpr std::uint64_t kLeftOut = 0xFFFFFFFFu;  // 32 of 52 bits
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(number) & ~kLeftOut);
}
template <std::size_t N>
void coarsen(std::array<double, N>& numbers) {
  for (double& number : numbers) number = coarse(number);
}

/// One for each hand up to the last in use, so that its place in the list is its number; unused ones are all zero.
std::vector<messages::ToolFrame> by_hand(const std::vector<messages::ToolFrame>& tools) {
  std::vector<messages::ToolFrame> hands;
  for (const messages::ToolFrame& tool : tools) {
    const auto place = static_cast<std::size_t>(std::max(tool.hand, 0));
    if (hands.size() <= place) hands.resize(place + 1);
    hands[place] = tool;
  }
  return hands;
}

messages::SceneFrame coarse_readings(const messages::SceneFrame& frame) {
  messages::SceneFrame out;
  out.sequence = frame.sequence;
  out.time_s = frame.time_s;
  out.residual_share = coarse(frame.residual_share);
  out.rates = frame.rates;
  out.notice = frame.notice;
  out.tools = by_hand(frame.tools);
  using Numbers = std::vector<double> messages::SceneFrame::*;
  for (const Numbers list :
       {&messages::SceneFrame::activations, &messages::SceneFrame::tensions_N, &messages::SceneFrame::stretches,
        &messages::SceneFrame::volume_ratios, &messages::SceneFrame::smallest_volume_ratios}) {
    out.*list = frame.*list;
    for (double& number : out.*list) number = coarse(number);
  }
  out.lines_world_m = frame.lines_world_m;
  for (auto& line : out.lines_world_m) {
    for (auto& point : line) coarsen(point);
  }
  out.springs_world_m = frame.springs_world_m;
  out.joints = frame.joints;
  for (messages::JointFrame& joint : out.joints) {
    for (messages::MuscleJointFrame& muscle : joint.muscles) {
      for (double* number : {&muscle.torque_Nm, &muscle.stiffness_Nm_rad, &muscle.line_muscle_Nm_rad,
                             &muscle.line_geometry_Nm_rad, &muscle.moment_arm_m}) {
        *number = coarse(*number);
      }
    }
  }
  return out;
}

/// How far each vertex is from the place before; those of one axis lie together, which compresses better.
void put_skin(std::size_t index, const GridSkin& skin, const GridSkin* before, Bytes& out) {
  ByteWriter writer(out);
  writer.put(static_cast<std::uint16_t>(index));
  writer.put(static_cast<std::uint32_t>(skin.size()));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t v = 0; v < skin.size(); ++v) {
      put_varint(out, std::int64_t{skin[v][axis]} - (before != nullptr ? (*before)[v][axis] : 0));
    }
  }
}

void put_skins(const ScenePicture& picture, const ScenePicture* seen, Bytes& out) {
  const auto before = [&](std::size_t s) { return seen != nullptr ? &seen->skins[s] : nullptr; };
  std::vector<std::size_t> changed;
  for (std::size_t s = 0; s < picture.skins.size(); ++s) {
    if (before(s) == nullptr || picture.skins[s] != *before(s)) changed.push_back(s);
  }
  ByteWriter(out).put(static_cast<std::uint16_t>(changed.size()));
  for (const std::size_t s : changed) put_skin(s, picture.skins[s], before(s), out);
}

void put_numbers(const ScenePicture& picture, const ScenePicture* seen, Bytes& out) {
  const bool has_news = picture.readings && (seen == nullptr || seen->readings != picture.readings);
  const bool is_in_force = seen == nullptr || seen->in_force != picture.in_force;
  ByteWriter writer(out);
  writer.put(static_cast<std::uint8_t>((has_news ? kWithReadings : 0) | (is_in_force ? kWithInForce : 0)));
  const auto put_part = [&](const Bytes& part) {
    writer.put(static_cast<std::uint32_t>(part.size()));
    writer.put_bytes(part.data(), part.size());
  };
  if (has_news) put_part(*picture.readings);
  if (is_in_force) put_part(picture.in_force);
}

/// Whether one can be told as a change of the other.
bool fit(const ScenePicture& a, const ScenePicture& b) {
  return std::equal(a.skins.begin(), a.skins.end(), b.skins.begin(), b.skins.end(),
                    [](const GridSkin& one, const GridSkin& other) { return one.size() == other.size(); });
}

void put_compressed(const Bytes& bytes, Bytes& out) {
  constexpr int kLevel = 3;  // the next ones take twice the time for a tenth less
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  const std::size_t head = out.size();
  out.resize(head + size);
  if (compress2(out.data() + head, &size, bytes.data(), static_cast<uLong>(bytes.size()), kLevel) != Z_OK) {
    throw Error(ExitStatus::Internal, "a picture cannot be compressed: no memory");
  }
  out.resize(head + size);
}

Bytes make_payload(const ScenePicture& picture, const ScenePicture* seen) {
  if (seen != nullptr && !fit(picture, *seen)) seen = nullptr;
  Bytes inner;
  ByteWriter writer(inner);
  writer.put(picture.time_s);
  writer.put(static_cast<std::uint16_t>(picture.poses.size()));
  for (const auto& pose : picture.poses) writer.put(pose);
  put_skins(picture, seen, inner);
  put_numbers(picture, seen, inner);
  Bytes payload;
  ByteWriter head(payload);
  head.put(picture.sequence);
  head.put(seen != nullptr ? seen->sequence : std::uint64_t{0});
  put_compressed(inner, payload);
  return payload;
}

}  // namespace

Bytes picture_payload(const ScenePicture& picture, const ScenePicture* seen) {
  if (seen != nullptr && seen->sequence == picture.before && !picture.since_before.empty()) return picture.since_before;
  return make_payload(picture, seen);
}

std::shared_ptr<const ScenePicture> PictureEncoder::encode(const messages::SceneFrame& frame) {
  auto picture = std::make_shared<ScenePicture>();
  picture->sequence = frame.sequence;
  picture->time_s = frame.time_s;
  for (const auto& skin : frame.skins_world_m) picture->skins.push_back(on_grid(skin));
  for (const auto& pose : frame.body_poses) {
    auto& small = picture->poses.emplace_back();
    std::transform(pose.begin(), pose.end(), small.begin(), [](double number) { return static_cast<float>(number); });
  }
  if (last_) picture->readings = last_->readings;
  if (--until_readings_ <= 0 || !last_) {
    until_readings_ = kPicturesAReading;
    Bytes readings;
    encode_readings(coarse_readings(frame), readings);
    picture->readings = std::make_shared<const Bytes>(std::move(readings));
  }
  encode_control_state(frame.control, picture->in_force);
  if (last_) {
    picture->before = last_->sequence;
    picture->since_before = make_payload(*picture, last_.get());
  }
  last_ = picture;
  return picture;
}

}  // namespace myotact::net
