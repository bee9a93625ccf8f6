#include "view/state/frame_history.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace myotact::view {

namespace {

constexpr float kSteps = 65535.0f;  // of a 16-bit number

}  // namespace

void FrameHistory::pack_skins(const messages::SceneFrame& frame, Kept& kept) {
  std::array<float, 3> lowest{}, highest{};
  bool first = true;
  for (const auto& skin : frame.skins_world_m) {
    kept.vertices.push_back(static_cast<std::uint32_t>(skin.size()));
    for (const auto& p : skin) {
      for (std::size_t a = 0; a < 3; ++a) {
        lowest[a] = first ? p[a] : std::min(lowest[a], p[a]);
        highest[a] = first ? p[a] : std::max(highest[a], p[a]);
      }
      first = false;
    }
  }
  kept.lowest_m = lowest;
  for (std::size_t a = 0; a < 3; ++a) kept.step_m[a] = (highest[a] - lowest[a]) / kSteps;
  for (const auto& skin : frame.skins_world_m) {
    for (const auto& p : skin) {
      for (std::size_t a = 0; a < 3; ++a) {
        const float steps = kept.step_m[a] > 0.0f ? (p[a] - lowest[a]) / kept.step_m[a] : 0.0f;
        kept.skins.push_back(static_cast<std::uint16_t>(std::clamp(std::round(steps), 0.0f, kSteps)));
      }
    }
  }
}

std::size_t FrameHistory::bytes_of(const Kept& kept) {
  const messages::SceneFrame& rest = kept.rest;
  std::size_t bytes = sizeof(FrameHistory::Kept) + kept.skins.size() * sizeof(std::uint16_t);
  bytes += kept.vertices.size() * sizeof(std::uint32_t) + rest.body_poses.size() * sizeof(rest.body_poses[0]);
  for (const auto* numbers :
       {&rest.activations, &rest.tensions_N, &rest.stretches, &rest.volume_ratios, &rest.smallest_volume_ratios}) {
    bytes += numbers->size() * sizeof(double);
  }
  for (const auto& line : rest.lines_world_m)
    bytes += sizeof(std::vector<std::array<double, 3>>) + line.size() * sizeof(std::array<double, 3>);
  bytes += rest.springs_world_m.size() * sizeof(rest.springs_world_m[0]);
  for (const messages::JointFrame& joint : rest.joints) {
    bytes += sizeof(joint) + joint.muscles.size() * sizeof(messages::MuscleJointFrame);
  }
  return bytes + rest.tools.size() * sizeof(messages::ToolFrame) + rest.notice.size();
}

bool FrameHistory::continues(const messages::SceneFrame& frame) const {
  const messages::SceneFrame& last = kept_.back().rest;
  return frame.time_s >= last.time_s && frame.body_poses.size() == last.body_poses.size() &&
         frame.skins_world_m.size() == kept_.back().vertices.size();
}

void FrameHistory::add(const messages::SceneFrame& frame) {
  if (frame.body_poses.empty()) return;  // nothing was simulated yet
  if (!kept_.empty() && !continues(frame)) {
    kept_.clear();
    bytes_ = 0;
  }
  if (!kept_.empty() && frame.time_s == time_s(kept_.size() - 1)) return;
  Kept next;
  std::size_t vertices = 0;
  for (const auto& skin : frame.skins_world_m) vertices += skin.size();
  next.skins.reserve(3 * vertices);
  next.vertices.reserve(frame.skins_world_m.size());
  pack_skins(frame, next);
  messages::SceneFrame& rest = next.rest;
  rest.sequence = frame.sequence;
  rest.time_s = frame.time_s;
  rest.residual_share = frame.residual_share;
  rest.body_poses = frame.body_poses;
  rest.activations = frame.activations;
  rest.tensions_N = frame.tensions_N;
  rest.stretches = frame.stretches;
  rest.volume_ratios = frame.volume_ratios;
  rest.smallest_volume_ratios = frame.smallest_volume_ratios;
  rest.lines_world_m = frame.lines_world_m;
  rest.springs_world_m = frame.springs_world_m;
  rest.joints = frame.joints;
  rest.tools = frame.tools;
  rest.rates = frame.rates;
  rest.control = frame.control;
  rest.notice = frame.notice;
  next.bytes = bytes_of(next);
  bytes_ += next.bytes;
  kept_.push_back(std::move(next));
  make_room();
}

void FrameHistory::remove(std::size_t i) {
  bytes_ -= kept_[i].bytes;
  kept_.erase(kept_.begin() + static_cast<std::ptrdiff_t>(i));
}

void FrameHistory::make_room() {
  const double now_s = kept_.back().rest.time_s;
  while (kept_.front().rest.time_s < now_s - longest_s_) remove(0);
  while (bytes_ > most_bytes_ && kept_.size() > 2) {
    std::size_t least = 1;
    double least_share = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i + 1 < kept_.size(); ++i) {
      const double share = (time_s(i + 1) - time_s(i - 1)) / (now_s - time_s(i));
      if (share >= least_share) continue;
      least_share = share;
      least = i;
    }
    remove(least);
  }
}

std::optional<std::size_t> FrameHistory::nearest(double time_s) const {
  if (kept_.empty()) return std::nullopt;
  const auto after = std::lower_bound(kept_.begin(), kept_.end(), time_s,
                                      [](const Kept& kept, double t) { return kept.rest.time_s < t; });
  if (after == kept_.end()) return kept_.size() - 1;
  const auto i = static_cast<std::size_t>(after - kept_.begin());
  if (i > 0 && time_s - this->time_s(i - 1) < this->time_s(i) - time_s) return i - 1;
  return i;
}

void FrameHistory::fetch(std::size_t i, messages::SceneFrame& frame) const {
  const Kept& kept = kept_[i];
  auto skins = std::move(frame.skins_world_m);  // their memory is used again
  frame = kept.rest;
  skins.resize(kept.vertices.size());
  std::size_t next = 0;
  for (std::size_t m = 0; m < skins.size(); ++m) {
    skins[m].resize(kept.vertices[m]);
    for (auto& p : skins[m]) {
      for (std::size_t a = 0; a < 3; ++a) {
        p[a] = kept.lowest_m[a] + kept.step_m[a] * static_cast<float>(kept.skins[next++]);
      }
    }
  }
  frame.skins_world_m = std::move(skins);
}

}  // namespace myotact::view
