#include "simulation/line_model.h"

#include <algorithm>
#include <cmath>

#include "simulation/fibre_curves.h"

namespace myotact::simulation {
namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

/// A point on a body, where it is now.
struct BodyPoint {
  int body;
  Vec3 p_W;
};

BodyPoint body_point(const anatomy::LinePoint& point, const Skeleton& skeleton) {
  return {point.body, skeleton.body_pose(point.body) * point.position_m};
}

Vec3 spread(const Skeleton& skeleton, const BodyPoint& a, const BodyPoint& b, int joint) {
  return skeleton.point_derivative(b.body, joint, b.p_W) - skeleton.point_derivative(a.body, joint, a.p_W);
}

/// With e = b - a, s = |e|, u = e/s: ds = u.de, d2s = u.d2e + (de.de - (u.de)(u.de))/s.
void add_segment(const Skeleton& skeleton, const BodyPoint& a, const BodyPoint& b, LineGeometry& geometry) {
  const Vec3 e = b.p_W - a.p_W;
  const double s = e.norm();
  if (s == 0.0) return;
  const Vec3 u = e / s;
  geometry.length_m += s;
  for (int j = 0; j < skeleton.joint_count(); ++j) {
    const Vec3 de_j = spread(skeleton, a, b, j);
    geometry.slope_m_rad[j] += u.dot(de_j);
    for (int k = 0; k < skeleton.joint_count(); ++k) {
      const Vec3 de_k = spread(skeleton, a, b, k);
      const Vec3 d2e =
          skeleton.point_second_derivative(b.body, j, k, b.p_W) - skeleton.point_second_derivative(a.body, j, k, a.p_W);
      geometry.curvature_m_rad2(j, k) += u.dot(d2e) + (de_j.dot(de_k) - u.dot(de_j) * u.dot(de_k)) / s;
    }
  }
}

}  // namespace

void measure_line(const anatomy::MuscleLine& line, const Skeleton& skeleton, LineGeometry& geometry) {
  const int n = skeleton.joint_count();
  geometry.length_m = 0.0;
  geometry.slope_m_rad.setZero(n);
  geometry.curvature_m_rad2.setZero(n, n);
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    add_segment(skeleton, body_point(line.points[i - 1], skeleton), body_point(line.points[i], skeleton), geometry);
  }
}

bool spans_joint(const anatomy::MuscleLine& line, const Skeleton& skeleton, int joint) {
  const auto distal = [&](const anatomy::LinePoint& point) { return skeleton.is_distal(point.body, joint); };
  return std::any_of(line.points.begin(), line.points.end(), distal) &&
         !std::all_of(line.points.begin(), line.points.end(), distal);
}

std::vector<Vec3> line_points_W(const anatomy::MuscleLine& line, const Skeleton& skeleton) {
  std::vector<Vec3> points_W;
  points_W.reserve(line.points.size());
  for (const anatomy::LinePoint& point : line.points) points_W.push_back(body_point(point, skeleton).p_W);
  return points_W;
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
