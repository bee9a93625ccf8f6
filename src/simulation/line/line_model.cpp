#include "simulation/line/line_model.h"

#include <algorithm>
#include <cmath>

#include "core/at.h"
#include "simulation/curves/fibre_curves.h"
#include "simulation/line/line_segment.h"

namespace myotact::simulation {
namespace {

LineStop stop_at(const anatomy::LinePoint& point, const Skeleton& skeleton) {
  return {point.body, skeleton.body_pose(point.body) * point.position_m};
}

void add_segment(const Skeleton& skeleton, const LineSegment& segment, LineGeometry& geometry) {
  geometry.length_m += segment.length_m;
  for (int j = 0; j < skeleton.joint_count(); ++j) {
    if (!segment.changes_with(skeleton, j)) continue;
    geometry.slope_m_rad[j] += segment.by_angle(skeleton, j);
    for (int k = 0; k < skeleton.joint_count(); ++k) {
      if (segment.changes_with(skeleton, k)) geometry.curvature_m_rad2(j, k) += segment.by_angles(skeleton, j, k);
    }
  }
}

/// `pose_of` gives the pose of a body.
template <class PoseOf>
std::vector<Vec3> line_points(const anatomy::MuscleLine& line, PoseOf&& pose_of) {
  std::vector<Vec3> points_m;
  points_m.reserve(line.points.size() + line.wraps.size() * kWrapPoints);
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
    const anatomy::LinePoint &from = line.points[i], &to = line.points[i + 1];
    const anatomy::LineWrap* wrap = anatomy::wrap_after(line, i);
    add_segment_points(pose_of(from.body) * from.position_m, pose_of(to.body) * to.position_m, wrap,
                       wrap == nullptr ? Pose{} : pose_of(wrap->body), points_m);
  }
  points_m.push_back(pose_of(line.points.back().body) * line.points.back().position_m);
  return points_m;
}

}  // namespace

void measure_line(const anatomy::MuscleLine& line, const Skeleton& skeleton, LineGeometry& geometry) {
  const int n = skeleton.joint_count();
  geometry.length_m = 0.0;
  geometry.slope_m_rad.setZero(n);
  geometry.curvature_m_rad2.setZero(n, n);
  geometry.stuck_wrap = -1;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    const anatomy::LineWrap* wrap = anatomy::wrap_after(line, i - 1);
    const LineSegment segment =
        measure_segment(skeleton, stop_at(line.points[i - 1], skeleton), stop_at(line.points[i], skeleton), wrap);
    if (!segment.clears) geometry.stuck_wrap = static_cast<int>(wrap - line.wraps.data());
    add_segment(skeleton, segment, geometry);
  }
}

bool spans_joint(const anatomy::MuscleLine& line, const Skeleton& skeleton, int joint) {
  const bool distal = skeleton.is_distal(line.points.front().body, joint);
  const auto differs = [&](const auto& part) { return skeleton.is_distal(part.body, joint) != distal; };
  return std::any_of(line.points.begin(), line.points.end(), differs) ||
         std::any_of(line.wraps.begin(), line.wraps.end(), differs);
}

std::vector<Vec3> line_points_W(const anatomy::MuscleLine& line, const Skeleton& skeleton) {
  return line_points(line, [&](int body) { return skeleton.body_pose(body); });
}

std::vector<Vec3> line_points_L(const anatomy::MuscleLine& line) {
  return line_points(line, [](int) { return Pose{}; });
}

LineForce line_force(const anatomy::Muscle& muscle, double elongation_m, double speed_m_s, double activation) {
  const double lo_m = muscle.optimal_fibre_m;
  const double width_m = lo_m * std::sin(muscle.pennation_rad);
  const double rest_m = muscle.rest_stretch * lo_m;
  const double reach_m =
      std::sqrt(std::max(0.0, rest_m * rest_m - width_m * width_m)) + elongation_m;  // along the line
  LineForce force;
  if (reach_m <= 0.0) return force;  // slack
  const double fibre_m = std::hypot(reach_m, width_m);
  const double cosine = reach_m / fibre_m;
  const double cosine_slope_1_m = (1.0 - cosine * cosine) / fibre_m;
  const double n = fibre_m / lo_m;
  const double fastest_m_s = kLargestShortening_lo_s * lo_m;
  const double v = speed_m_s * cosine / fastest_m_s;
  const double length_N = muscle.peak_force_N * activation * active_force_length(n);
  const double velocity_factor = force_velocity(v);
  const double fibre_N = length_N * velocity_factor + muscle.peak_force_N * passive_force_length(n);
  const double fibre_slope_N_m =
      muscle.peak_force_N / lo_m * cosine *
          (activation * active_force_length_slope(n) * velocity_factor + passive_force_length_slope(n)) +
      length_N * force_velocity_slope(v) * speed_m_s * cosine_slope_1_m / fastest_m_s;
  force.fibre_stretch = n;
  force.force_N = fibre_N * cosine;
  force.stiffness_N_m = fibre_slope_N_m * cosine + fibre_N * cosine_slope_1_m;
  force.damping_Ns_m = length_N * force_velocity_slope(v) * cosine * cosine / fastest_m_s;
  return force;
}

LineJointTerms& LineJointTerms::operator+=(const LineJointTerms& other) {
  torque_Nm += other.torque_Nm;
  muscle_Nm_rad += other.muscle_Nm_rad;
  geometry_Nm_rad += other.geometry_Nm_rad;
  damping_Nms_rad += other.damping_Nms_rad;
  return *this;
}

LineJointTerms line_joint_terms(const LineGeometry& geometry, const LineForce& force, int joint) {
  const double r_m = -geometry.slope_m_rad[joint];
  const double dr_dq_m = -geometry.curvature_m_rad2(joint, joint);
  return {r_m * force.force_N, r_m * r_m * force.stiffness_N_m, -dr_dq_m * force.force_N,
          r_m * r_m * force.damping_Ns_m};
}

std::vector<double> arc_fractions(std::span<const Vec3> points_m) {
  std::vector<double> fractions(points_m.size(), 0.0);
  if (points_m.empty()) return fractions;
  for (std::size_t i = 1; i < points_m.size(); ++i) {
    fractions[i] = fractions[i - 1] + (points_m[i] - points_m[i - 1]).norm();
  }
  const double length_m = fractions.back();
  if (length_m > 0.0) {
    for (double& fraction : fractions) fraction /= length_m;
  }
  fractions.back() = 1.0;
  return fractions;
}

LinePlace nearest_place(std::span<const Vec3> points_m, std::span<const double> fractions, const Vec3& p_m) noexcept {
  LinePlace best{0, 0.0, fractions[0], points_m[0], (points_m[0] - p_m).norm()};
  for (std::size_t i = 0; i + 1 < points_m.size(); ++i) {
    const Vec3 e = points_m[i + 1] - points_m[i];
    const double squared = e.squaredNorm();
    const double along = squared > 0.0 ? std::clamp((p_m - points_m[i]).dot(e) / squared, 0.0, 1.0) : 0.0;
    const Vec3 position_m = points_m[i] + along * e;
    const double distance_m = (position_m - p_m).norm();
    if (distance_m >= best.distance_m) continue;
    const double fraction = fractions[i] + along * (fractions[i + 1] - fractions[i]);
    best = {static_cast<int>(i), along, fraction, position_m, distance_m};
  }
  return best;
}

LinePlace place_at_fraction(std::span<const Vec3> points_m, std::span<const double> fractions,
                            double fraction) noexcept {
  if (points_m.size() < 2) return {0, 0.0, fractions[0], points_m[0], 0.0};
  const double wanted = std::clamp(fraction, 0.0, 1.0);
  int segment = 0;
  const int last = static_cast<int>(points_m.size()) - 2;
  while (segment < last && wanted > fractions[at(segment + 1)]) ++segment;
  const double width = fractions[at(segment + 1)] - fractions[at(segment)];
  const double along = width > 0.0 ? std::clamp((wanted - fractions[at(segment)]) / width, 0.0, 1.0) : 0.0;
  const Vec3 position_m = points_m[at(segment)] + along * (points_m[at(segment + 1)] - points_m[at(segment)]);
  return {segment, along, wanted, position_m, 0.0};
}

}  // namespace myotact::simulation
