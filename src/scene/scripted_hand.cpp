#include "scene/scripted_hand.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include <Eigen/Geometry>

#include "messages/device.h"

namespace myotact::scene {

namespace {

constexpr double kStandOff_m = 0.03;  // the hand comes to this distance from the skin before it presses
constexpr double kLiftOff_m = 0.04;
constexpr double kGrabGap_m = 0.005;  // the stylus takes a line or a bone from just outside
constexpr int kSlideWaypoints = 16;   // about 5 mm apart on a 90 mm belly

/// Distance along the ray origin + t direction to the triangle, if it is hit (Moeller and Trumbore 1997).
std::optional<double> ray_hit(const Vec3& origin, const Vec3& direction, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 p = direction.cross(ac);
  const double determinant = ab.dot(p);
  if (std::abs(determinant) < 1e-18) return std::nullopt;  // parallel, or a triangle without area
  const Vec3 s = origin - a;
  const double u = s.dot(p) / determinant;
  const Vec3 q = s.cross(ab);
  const double v = direction.dot(q) / determinant;
  const double t = ac.dot(q) / determinant;
  if (u < 0.0 || v < 0.0 || u + v > 1.0 || t < 0.0) return std::nullopt;
  return t;
}

/// Farthest place along the ray origin + t direction where it meets the surface, or the origin.
Vec3 outermost_hit(const Vec3& origin, const Vec3& direction, std::span<const std::array<int, 3>> triangles,
                   std::span<const Vec3> positions_m) {
  const auto at = [&](int vertex) { return positions_m[static_cast<std::size_t>(vertex)]; };
  double outermost = 0.0;
  for (const auto& t : triangles) {
    const auto hit = ray_hit(origin, direction, at(t[0]), at(t[1]), at(t[2]));
    if (hit) outermost = std::max(outermost, *hit);
  }
  return origin + outermost * direction;
}

double minimum_jerk(double s) {
  return s * s * s * (10.0 + s * (6.0 * s - 15.0));
}

}  // namespace

Vec3 point_at_fraction(const std::vector<Vec3>& points, double fraction) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  double left = std::clamp(fraction, 0.0, 1.0) * length;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double segment = (points[i] - points[i - 1]).norm();
    if (left <= segment && segment > 0.0) return points[i - 1] + left / segment * (points[i] - points[i - 1]);
    left -= segment;
  }
  return points.back();
}

ScriptedHand::ScriptedHand(const anatomy::Specimen& specimen, const Vec3& start_world_m) : specimen_(&specimen) {
  path_.push_back({0.0, start_world_m, 0});
}

HandTarget ScriptedHand::target(double time_s) const {
  const auto later = std::find_if(path_.begin(), path_.end(), [&](const Waypoint& w) { return w.time_s > time_s; });
  if (later == path_.begin()) return {later->position_world_m, later->buttons};
  const Waypoint& from = *(later - 1);
  if (later == path_.end()) return {from.position_world_m, from.buttons};
  const double passed = (time_s - from.time_s) / (later->time_s - from.time_s);
  const double s = later->arrives_moving ? passed : minimum_jerk(passed);
  return {from.position_world_m + s * (later->position_world_m - from.position_world_m), from.buttons};
}

void ScriptedHand::begin(const ScriptAction& action, const simulation::Simulation& simulation) {
  const HandTarget now = target(action.start_s);
  const std::vector<Waypoint> before = path_;
  path_.assign(1, {action.start_s, now.position_world_m, now.buttons});
  if (const auto* move = std::get_if<MoveHand>(&action.what)) return lay_out(action, *move);
  if (const auto* touch = std::get_if<TouchMuscle>(&action.what)) return lay_out(action, *touch, simulation);
  if (const auto* slide = std::get_if<SlideOnMuscle>(&action.what)) return lay_out(action, *slide, simulation);
  if (const auto* grab = std::get_if<GrabLine>(&action.what)) return lay_out(action, *grab, simulation);
  if (const auto* grab = std::get_if<GrabBone>(&action.what)) return lay_out(action, *grab, simulation);
  if (const auto* release = std::get_if<ReleaseHand>(&action.what)) return lay_out(action, *release);
  path_ = before;
}

void ScriptedHand::lay_out(const ScriptAction& action, const MoveHand& what) {
  path_.push_back({action.end_s(), what.to_m, 0});
}

void ScriptedHand::lay_out(const ScriptAction& action, const TouchMuscle& what,
                           const simulation::Simulation& simulation) {
  touched_muscle_ = what.muscle;
  touched_at_ = what.at;
  from_ = what.from;
  const Vec3 skin = skin_point(simulation, what.muscle, what.at, what.from);
  path_.push_back({action.start_s + 0.5 * action.duration_s, skin + kStandOff_m * what.from, 0});
  path_.push_back({action.end_s(), skin - what.depth_m * what.from, 0});
}

void ScriptedHand::lay_out(const ScriptAction& action, const SlideOnMuscle& what,
                           const simulation::Simulation& simulation) {
  if (touched_muscle_ < 0) return;  // nothing was touched before: the hand stays where it is
  for (int i = 1; i <= kSlideWaypoints; ++i) {
    const double s = static_cast<double>(i) / kSlideWaypoints;
    const double at = touched_at_ + s * (what.to - touched_at_);
    const Vec3 skin = skin_point(simulation, touched_muscle_, at, from_);
    path_.push_back({action.start_s + s * action.duration_s, skin - what.depth_m * from_, 0, true});
  }
  touched_at_ = what.to;
}

void ScriptedHand::lay_out(const ScriptAction& action, const GrabLine& what, const simulation::Simulation& simulation) {
  touched_muscle_ = what.muscle;
  touched_at_ = what.at;
  from_ = what.from;
  const Vec3 skin = skin_point(simulation, what.muscle, what.at, what.from);
  grab(action, skin + kGrabGap_m * what.from, what.drag_m, messages::kGrabButton);
}

void ScriptedHand::lay_out(const ScriptAction& action, const GrabBone& what, const simulation::Simulation& simulation) {
  touched_muscle_ = -1;
  from_ = what.from;
  const Vec3 surface = bone_point(simulation, what.bone, what.from);
  grab(action, surface + kGrabGap_m * what.from, what.drag_m, messages::kGrabBoneButton);
}

void ScriptedHand::grab(const ScriptAction& action, const Vec3& grip, const Vec3& drag_m, std::uint32_t button) {
  const double start = action.start_s;
  const double duration = action.duration_s;
  path_.push_back({start + 0.2 * duration, grip + kStandOff_m * from_, 0});
  path_.push_back({start + 0.4 * duration, grip, 0});
  path_.push_back({start + 0.45 * duration, grip, button});
  path_.push_back({start + 0.9 * duration, grip + drag_m, button});
  path_.push_back({action.end_s(), grip + drag_m, button});
}

void ScriptedHand::lay_out(const ScriptAction& action, const ReleaseHand&) {
  path_.front().buttons = 0;
  path_.push_back({action.end_s(), path_.front().position_world_m + kLiftOff_m * from_, 0});
}

Vec3 ScriptedHand::skin_point(const simulation::Simulation& simulation, int muscle, double at, const Vec3& from) const {
  const auto& skin = specimen_->muscles[static_cast<std::size_t>(muscle)].skin;
  return outermost_hit(point_at_fraction(simulation.line_world_m(muscle), at), from, skin.triangles,
                       simulation.skin_world_m(muscle));
}

Vec3 ScriptedHand::bone_point(const simulation::Simulation& simulation, int bone, const Vec3& from) const {
  const anatomy::Bone& chosen = specimen_->bones[static_cast<std::size_t>(bone)];
  const Pose pose = simulation.body_pose(chosen.body);
  std::vector<Vec3> positions_m;
  Vec3 sum = Vec3::Zero();
  for (const Vec3& rest_m : chosen.surface.positions_m) {
    positions_m.push_back(pose * rest_m);
    sum += positions_m.back();
  }
  return outermost_hit(sum / static_cast<double>(positions_m.size()), from, chosen.surface.triangles, positions_m);
}

}  // namespace myotact::scene
