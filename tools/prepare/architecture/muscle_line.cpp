#include "prepare/architecture/muscle_line.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <fmt/format.h>

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
                               const LineEnds& ends, const LineBones& bones) {
  std::vector<Vec3> points_m{ends.origin_m};
  points_m.insert(points_m.end(), profile.centre_m.begin(), profile.centre_m.end());
  points_m.push_back(ends.insertion_m);
  const Way way(std::move(points_m));
  const std::vector<int> path = joints_between(name, bones);
  const std::vector<double> crossed_m = crossings_m(way, bones, path);

  std::vector<double> taken_m{0.0, way.length_m()};
  for (const double arc_m : wanted_arcs_m(way, profile, belly)) {
    if (clear_of(taken_m, arc_m, kLeastSpacing_m) && clear_of(crossed_m, arc_m, kClearOfAxis_m)) {
      taken_m.push_back(arc_m);
    }
  }
  std::sort(taken_m.begin(), taken_m.end());
  anatomy::MuscleLine line;
  for (const double arc_m : taken_m) {
    line.points.push_back({body_at(arc_m, bones, path, crossed_m), way.at(arc_m), LinePointKind::Via});
  }
  line.points.front() = {bones.origin_body, ends.origin_m, LinePointKind::Origin};
  line.points.back() = {bones.insertion_body, ends.insertion_m, LinePointKind::Insertion};
  return line;
}

double moment_arm_m(const anatomy::MuscleLine& line, const Joint& joint, const LineBones& bones) {
  if (joint.type != anatomy::JointType::Hinge) return 0.0;
  // Bodies that move with the joint: the child and what hangs on it.
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
  double lever_m = 0.0;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    const LinePoint& a = line.points[i - 1];
    const LinePoint& b = line.points[i];
    const bool a_distal = distal[static_cast<std::size_t>(a.body)], b_distal = distal[static_cast<std::size_t>(b.body)];
    if (a_distal == b_distal) continue;
    const Vec3& pulled = a_distal ? a.position_m : b.position_m;
    const Vec3 pull = ((a_distal ? b.position_m : a.position_m) - pulled).normalized();
    lever_m += joint.axes[0].dot((pulled - joint.centre_m).cross(pull));
  }
  return lever_m;
}

}  // namespace myotact::prepare
