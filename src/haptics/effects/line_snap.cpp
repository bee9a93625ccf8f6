#include "haptics/effects/line_snap.h"

#include <algorithm>
#include <cmath>

namespace myotact::haptics {

namespace {

constexpr double kFade_s = 0.03;  // a change of line is no knock: below 30 Hz
/// Largest slope of (1 - s^2)^2, at s = 1/sqrt(3).
constexpr double kSteepest = 1.5396007178390020;

/// From the nearest point of a segment to p.
Vec3 from_segment_m(const Vec3& a, const Vec3& b, const Vec3& p) {
  const Vec3 along = b - a;
  const double length_m2 = along.squaredNorm();
  const double share = length_m2 > 0.0 ? std::clamp(along.dot(p - a) / length_m2, 0.0, 1.0) : 0.0;
  return p - (a + share * along);
}

}  // namespace

double LineSnap::depth_J() const noexcept {
  return settings_.force_N * settings_.reach_m / kSteepest;
}

double LineSnap::held_J() const noexcept {
  return gain_ * depth_J();
}

Vec3 LineSnap::tick(const messages::LocalLine& line, const Vec3& tool_m, bool open, double dt_s) noexcept {
  const bool wanted = open && line.muscle >= 0 && settings_.force_N > 0.0;
  if (gain_ <= 0.0) line_ = wanted ? line : messages::LocalLine{};
  const bool same = wanted && line.muscle == line_.muscle;
  if (same) line_ = line;
  gain_ = std::clamp(gain_ + (same ? dt_s : -dt_s) / kFade_s, 0.0, 1.0);
  if (line_.muscle < 0) return Vec3::Zero();
  const Vec3 on_line_m = to_vec3(line_.grab_point_world_m);
  const Vec3 above_m = from_segment_m(to_vec3(line_.proximal_point_world_m), on_line_m, tool_m);
  const Vec3 below_m = from_segment_m(on_line_m, to_vec3(line_.distal_point_world_m), tool_m);
  const Vec3 away_m = above_m.squaredNorm() < below_m.squaredNorm() ? above_m : below_m;
  const double share2 = away_m.squaredNorm() / (settings_.reach_m * settings_.reach_m);
  if (share2 >= 1.0) return Vec3::Zero();
  return -gain_ * 4.0 * depth_J() / (settings_.reach_m * settings_.reach_m) * (1.0 - share2) * away_m;
}

}  // namespace myotact::haptics
