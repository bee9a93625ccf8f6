#include "prepare/architecture/muscle_line.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "anatomy/find_wrap_defects.h"
#include "core/error.h"

namespace myotact::prepare {

namespace {

using anatomy::Joint;
using anatomy::LinePoint;
using anatomy::LinePointKind;

/// Points between the ends that a line aims at.
constexpr int kVias = 5;
/// No via point within this of a joint's axis along the line [m]: four times the axis's uncertainty of 3 mm.
constexpr double kClearOfAxis_m = 12e-3;
/// A tendon's line may pass a joint this far beside the tendon; where it would pass farther, as in front of a carpus,
/// retinacula hold it at both sides of the axis [m].
constexpr double kBowstring_m = 4e-3;
/// Points closer than this say nothing more [m].
constexpr double kLeastSpacing_m = 8e-3;
/// Steps at which the way is looked at when the place nearest to an axis is sought.
constexpr int kSamples = 400;

/// A polyline by its length.
class Way {
 public:
  explicit Way(std::vector<Vec3> points_m) : points_m_(std::move(points_m)) {
    arc_m_.push_back(0.0);
    for (std::size_t i = 1; i < points_m_.size(); ++i) {
      arc_m_.push_back(arc_m_.back() + (points_m_[i] - points_m_[i - 1]).norm());
    }
  }

  double length_m() const { return arc_m_.back(); }
  double arc_of_point_m(std::size_t i) const { return arc_m_[i]; }
  const Vec3& end_m() const { return points_m_.back(); }

  Vec3 at(double arc_m) const {
    const auto above = std::upper_bound(arc_m_.begin() + 1, arc_m_.end() - 1, arc_m);
    const auto i = static_cast<std::size_t>(above - arc_m_.begin());
    const double part = (arc_m - arc_m_[i - 1]) / std::max(arc_m_[i] - arc_m_[i - 1], 1e-12);
    return points_m_[i - 1] + std::clamp(part, 0.0, 1.0) * (points_m_[i] - points_m_[i - 1]);
  }

 private:
  std::vector<Vec3> points_m_;
  std::vector<double> arc_m_;
};

/// Length of the way up to its place nearest to `p`.
double nearest_arc_m(const Way& way, const Vec3& p) {
  double best_arc_m = 0.0, best_m = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kSamples; ++i) {
    const double arc_m = way.length_m() * i / kSamples;
    const double distance_m = (way.at(arc_m) - p).norm();
    if (distance_m < best_m) best_m = distance_m, best_arc_m = arc_m;
  }
  return best_arc_m;
}

/// The measured middle from where it is nearest to the one end to where it is nearest to the other: it is of the whole
/// muscle, and an end may lie beside it (the ischial origin of biceps femoris).
std::vector<Vec3> middle_between(const std::vector<Vec3>& middle_m, const Vec3& origin_m, const Vec3& end_m) {
  const Way whole(middle_m);
  const double begin_arc_m = nearest_arc_m(whole, origin_m), end_arc_m = nearest_arc_m(whole, end_m);
  std::vector<Vec3> between_m;
  for (std::size_t i = 0; i < middle_m.size(); ++i) {
    if (whole.arc_of_point_m(i) > begin_arc_m && whole.arc_of_point_m(i) < end_arc_m) between_m.push_back(middle_m[i]);
  }
  return between_m;
}

/// From the origin to where the line ends, through the muscle's middle.
Way way_of(const MuscleProfile& profile, const LineGuide& guide) {
  Vec3 end_m = guide.insertion_m;
  for (const CrossingData& crossing : guide.crossings) end_m = crossing.distal_point_m.value_or(end_m);
  const std::vector<Vec3> middle_m =
      guide.middle_m.empty() ? profile.centre_m : middle_between(guide.middle_m, guide.origin_m, end_m);
  std::vector<Vec3> points_m{guide.origin_m};
  points_m.insert(points_m.end(), middle_m.begin(), middle_m.end());
  points_m.push_back(end_m);
  return Way(std::move(points_m));
}

double distance_to_joint_m(const Joint& joint, const Vec3& p) {
  const Vec3 away = p - joint.centre_m;
  return joint.type == anatomy::JointType::Hinge ? away.cross(joint.axes[0]).norm() : away.norm();
}

double nearest_arc_m(const Way& way, const Joint& joint) {
  double best_arc_m = 0.0, best_m = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kSamples; ++i) {
    const double arc_m = way.length_m() * i / kSamples;
    const double distance_m = distance_to_joint_m(joint, way.at(arc_m));
    if (distance_m < best_m) best_m = distance_m, best_arc_m = arc_m;
  }
  return best_arc_m;
}

/// Ways at which via points are wanted: the belly's borders first, then evenly spread ones.
std::vector<double> wanted_arcs_m(const Way& way, const MuscleProfile& profile, const BellySpan& belly) {
  const double scale = way.length_m() / profile.length_m;
  std::vector<double> arcs_m;
  if (belly.begin_m > 0.0) arcs_m.push_back(belly.begin_m * scale);
  if (belly.end_m < profile.length_m) arcs_m.push_back(belly.end_m * scale);
  for (int i = 1; i <= kVias; ++i) arcs_m.push_back(way.length_m() * i / (kVias + 1));
  return arcs_m;
}

bool clear_of(const std::vector<double>& others_m, double arc_m, double spacing_m) {
  return std::all_of(others_m.begin(), others_m.end(),
                     [&](double other_m) { return std::abs(other_m - arc_m) >= spacing_m; });
}

/// How far the way is from the straight line between two of its places.
double bow_m(const Way& way, double begin_m, double end_m) {
  const Vec3 from_m = way.at(begin_m), along = (way.at(end_m) - from_m).normalized();
  double most_m = 0.0;
  for (int i = 1; i < kSamples; ++i) {
    const Vec3 away_m = way.at(begin_m + (end_m - begin_m) * i / kSamples) - from_m;
    most_m = std::max(most_m, (away_m - along * along.dot(away_m)).norm());
  }
  return most_m;
}

/// More points beside joints over which a tendon would be a bowstring; both lists rise.
std::vector<double> retinacula_m(const Way& way, const std::vector<double>& taken_m,
                                 const std::vector<double>& crossed_m) {
  std::vector<double> held_m;
  for (const double joint_m : crossed_m) {
    const auto after = std::upper_bound(taken_m.begin(), taken_m.end(), joint_m);
    if (after == taken_m.begin() || after == taken_m.end() || bow_m(way, *(after - 1), *after) < kBowstring_m) continue;
    for (const double arc_m : {joint_m - kClearOfAxis_m, joint_m + kClearOfAxis_m}) {
      const bool on_way = arc_m > 0.0 && arc_m < way.length_m();
      if (on_way && clear_of(taken_m, arc_m, kLeastSpacing_m) && clear_of(held_m, arc_m, kLeastSpacing_m)) {
        held_m.push_back(arc_m);
      }
    }
  }
  return held_m;
}

bool find_path(const LineBones& bones, int from, std::vector<bool>& seen, std::vector<int>& path) {
  if (from == bones.insertion_body) return true;
  seen[static_cast<std::size_t>(from)] = true;
  for (std::size_t j = 0; j < bones.joints.size(); ++j) {
    const Joint& joint = bones.joints[j];
    if (joint.parent != from && joint.child != from) continue;
    const int next = joint.parent == from ? joint.child : joint.parent;
    if (seen[static_cast<std::size_t>(next)]) continue;
    path.push_back(static_cast<int>(j));
    if (find_path(bones, next, seen, path)) return true;
    path.pop_back();
  }
  return false;
}

/// Way and joint of every crossing, in the joints' order.
std::vector<double> crossings_m(const Way& way, const LineBones& bones, const std::vector<int>& path) {
  std::vector<double> arcs_m;
  for (const int j : path) {
    const double arc_m = nearest_arc_m(way, bones.joints[static_cast<std::size_t>(j)]);
    arcs_m.push_back(arcs_m.empty() ? arc_m : std::max(arc_m, arcs_m.back()));
  }
  return arcs_m;
}

int body_at(double arc_m, const LineBones& bones, const std::vector<int>& path, const std::vector<double>& crossed_m) {
  int body = bones.origin_body;
  for (std::size_t i = 0; i < path.size() && arc_m > crossed_m[i]; ++i) {
    const Joint& joint = bones.joints[static_cast<std::size_t>(path[i])];
    body = joint.parent == body ? joint.child : joint.parent;
  }
  return body;
}

/// Part of the way in which a crossing allows no points.
struct Gap {
  double begin_m = 0.0, end_m = 0.0;

  bool holds(double arc_m) const { return arc_m > begin_m - kLeastSpacing_m && arc_m < end_m + kLeastSpacing_m; }
};

/// From `arc_m` on in the direction `sense`: where the way is first so far from the joint, or its end.
double arc_at_distance_m(const Way& way, const Joint& joint, double arc_m, int sense, double distance_m) {
  const double step_m = way.length_m() / kSamples;
  double here_m = arc_m, away_m = distance_to_joint_m(joint, way.at(here_m));
  while (away_m < distance_m) {
    const double next_m = here_m + sense * step_m;
    if (next_m < 0.0 || next_m > way.length_m()) return sense < 0 ? 0.0 : way.length_m();
    const double next_away_m = distance_to_joint_m(joint, way.at(next_m));
    if (next_away_m >= distance_m) {
      return here_m + (next_m - here_m) * (distance_m - away_m) / (next_away_m - away_m);
    }
    here_m = next_m;
    away_m = next_away_m;
  }
  return here_m;
}

/// The joints from origin to insertion.
struct JointPath {
  const LineBones& bones;
  const std::vector<int>& joints;
};

std::vector<Gap> gaps_of(const std::string& name, const LineGuide& guide, const JointPath& path, const Way& way,
                         const std::vector<double>& crossed_m) {
  std::vector<Gap> gaps;
  for (const CrossingData& crossing : guide.crossings) {
    const Joint& joint = path.bones.joints[static_cast<std::size_t>(crossing.joint)];
    const auto found = std::find(path.joints.begin(), path.joints.end(), crossing.joint);
    if (found == path.joints.end()) {
      throw bad_data(name, "crossing",
                     fmt::format("it does not cross the joint {} between its origin and its insertion", joint.key));
    }
    const double arc_m = crossed_m[static_cast<std::size_t>(found - path.joints.begin())];
    const double end_m =
        crossing.distal_m > 0.0 ? arc_at_distance_m(way, joint, arc_m, +1, crossing.distal_m) : way.length_m();
    gaps.push_back({arc_at_distance_m(way, joint, arc_m, -1, crossing.proximal_m), end_m});
  }
  return gaps;
}

/// Bodies that move with the joint: the child and what hangs on it.
std::vector<bool> distal_bodies(const Joint& joint, const LineBones& bones) {
  std::vector<bool> distal(bones.bodies.size(), false);
  distal[static_cast<std::size_t>(joint.child)] = true;
  for (bool grown = true; grown;) {
    grown = false;
    for (const Joint& other : bones.joints) {
      if (distal[static_cast<std::size_t>(other.parent)] && !distal[static_cast<std::size_t>(other.child)]) {
        grown = distal[static_cast<std::size_t>(other.child)] = true;
      }
    }
  }
  return distal;
}

/// Across the cylinder's axis, between the directions of the two ends, on the side of the straight segment.
Vec3 side_of(const anatomy::LineWrap& wrap, const Vec3& p_m, const Vec3& q_m) {
  const Vec3 axis = wrap.axes.row(2).transpose();
  const auto across = [&](const Vec3& v) { return Vec3(v - axis * axis.dot(v)); };
  const Vec3 p = across(p_m - wrap.centre_m), q = across(q_m - wrap.centre_m);
  return (p.normalized() + q.normalized()).normalized();
}

/// Unit directions of the line at the begin and at the end of the segment after point i.
std::pair<Vec3, Vec3> directions_at(const anatomy::MuscleLine& line, std::size_t i) {
  const Vec3 &from_m = line.points[i].position_m, &to_m = line.points[i + 1].position_m;
  const anatomy::LineWrap* wrap = anatomy::wrap_after(line, i);
  if (wrap == nullptr) return {(to_m - from_m).normalized(), (to_m - from_m).normalized()};
  const auto path = geometry::wrap_path(anatomy::surface_of(*wrap), anatomy::in_frame_of(*wrap, from_m),
                                        anatomy::in_frame_of(*wrap, to_m));
  return {-(wrap->axes.transpose() * path.slope_p), wrap->axes.transpose() * path.slope_q};
}

}  // namespace

std::vector<int> joints_between(const std::string& name, const LineBones& bones) {
  std::vector<int> path;
  std::vector<bool> seen(bones.bodies.size(), false);
  if (!find_path(bones, bones.origin_body, seen, path)) {
    throw bad_data(name, "attachments",
                   fmt::format("no joints lead from body {} to body {}; add the joints between them",
                               bones.bodies[static_cast<std::size_t>(bones.origin_body)].key,
                               bones.bodies[static_cast<std::size_t>(bones.insertion_body)].key));
  }
  return path;
}

anatomy::MuscleLine trace_line(const std::string& name, const MuscleProfile& profile, const BellySpan& belly,
                               const LineGuide& guide, const LineBones& bones) {
  const Way way = way_of(profile, guide);
  const std::vector<int> path = joints_between(name, bones);
  const std::vector<double> crossed_m = crossings_m(way, bones, path);
  const std::vector<Gap> gaps = gaps_of(name, guide, {bones, path}, way, crossed_m);

  std::vector<double> taken_m{0.0, way.length_m()};
  for (const Gap& gap : gaps) {
    for (const double arc_m : {gap.begin_m, gap.end_m}) {
      if (clear_of(taken_m, arc_m, 1e-9)) taken_m.push_back(arc_m);
    }
  }
  const auto in_gap = [&](double arc_m) {
    return std::any_of(gaps.begin(), gaps.end(), [&](const Gap& gap) { return gap.holds(arc_m); });
  };
  for (const double arc_m : wanted_arcs_m(way, profile, belly)) {
    if (!in_gap(arc_m) && clear_of(taken_m, arc_m, kLeastSpacing_m) && clear_of(crossed_m, arc_m, kClearOfAxis_m)) {
      taken_m.push_back(arc_m);
    }
  }
  std::sort(taken_m.begin(), taken_m.end());
  std::vector<double> by_tendon_m = crossed_m;  // where recipes do not say how
  const double scale = way.length_m() / profile.length_m;
  std::erase_if(by_tendon_m, [&](double arc_m) { return in_gap(arc_m) || !is_slender(profile, arc_m / scale); });
  for (const double arc_m : retinacula_m(way, taken_m, by_tendon_m)) taken_m.push_back(arc_m);
  std::sort(taken_m.begin(), taken_m.end());
  anatomy::MuscleLine line;
  for (const double arc_m : taken_m) {
    line.points.push_back({body_at(arc_m, bones, path, crossed_m), way.at(arc_m), LinePointKind::Via});
  }
  line.points.front() = {bones.origin_body, guide.origin_m, LinePointKind::Origin};
  line.points.back() = {bones.insertion_body, way.end_m(), LinePointKind::Insertion};
  return line;
}

void add_wraps(const std::string& name, const std::vector<WrapData>& wraps, const LineBones& bones,
               anatomy::MuscleLine& line) {
  for (const WrapData& data : wraps) {
    const Joint& joint = bones.joints[static_cast<std::size_t>(data.joint)];
    const std::vector<bool> distal = distal_bodies(joint, bones);
    const auto is_distal = [&](const LinePoint& point) { return distal[static_cast<std::size_t>(point.body)]; };
    const auto crosses = [&](const LinePoint& a, const LinePoint& b) { return is_distal(a) != is_distal(b); };
    const auto first = std::adjacent_find(line.points.begin(), line.points.end(), crosses);
    if (first == line.points.end()) {
      throw bad_data(name, "wraps", fmt::format("its line does not cross the joint {}; leave the wrap out", joint.key));
    }
    anatomy::LineWrap wrap = data.wrap;
    wrap.after = static_cast<int>(first - line.points.begin());
    if (!data.side_is_given) wrap.side = side_of(wrap, first->position_m, (first + 1)->position_m);
    line.wraps.push_back(wrap);
  }
  const std::vector<std::string> defects = anatomy::find_wrap_defects(line, "its line");
  if (!defects.empty()) throw bad_data(name, "wraps", defects.front());
}

double moment_arm_m(const anatomy::MuscleLine& line, const Joint& joint, const LineBones& bones) {
  if (joint.type != anatomy::JointType::Hinge) return 0.0;
  const std::vector<bool> distal = distal_bodies(joint, bones);
  double moment_arm_m = 0.0;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    const LinePoint& a = line.points[i - 1];
    const LinePoint& b = line.points[i];
    const bool a_distal = distal[static_cast<std::size_t>(a.body)], b_distal = distal[static_cast<std::size_t>(b.body)];
    if (a_distal == b_distal) continue;
    // The straight part that joins the two sides; a surface belongs to the side of its body.
    const anatomy::LineWrap* wrap = anatomy::wrap_after(line, i - 1);
    const bool with_b = wrap != nullptr && distal[static_cast<std::size_t>(wrap->body)] == b_distal;
    const auto [begin, end] = directions_at(line, i - 1);
    const Vec3 along = with_b ? begin : end;
    const Vec3& through_m = with_b ? a.position_m : b.position_m;
    moment_arm_m += (a_distal ? 1.0 : -1.0) * joint.axes[0].dot((through_m - joint.centre_m).cross(along));
  }
  return moment_arm_m;
}

}  // namespace myotact::prepare
