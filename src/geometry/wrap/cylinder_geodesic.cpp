#include <cmath>

#include <Eigen/Geometry>

#include "geometry/wrap/geodesic.h"

namespace myotact::geometry {
namespace {

/// Angle about z from the side to the point, in (-pi, pi]: jumps behind the cylinder only.
double angle_from_side(const Vec3& side, const Vec3& p) {
  return std::atan2(side.x() * p.y() - side.y() * p.x(), side.x() * p.x() + side.y() * p.y());
}

/// Rotation of the unit vector `side` about z, seen along z.
Vec3 rotated(const Vec3& side, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return Vec3(c * side.x() - s * side.y(), s * side.x() + c * side.y(), 0.0);
}

}  // namespace

// Unrolled, the string is straight: its planar length l (tangents and arc) and its rise dz make S^2 = l^2 + dz^2.
std::optional<Geodesic> geodesic_on_cylinder(const WrapSurface& surface, const Vec3& p_m, const Vec3& q_m) {
  const double radius_m = surface.radii_m[0];
  const Vec3 side = Vec3(surface.side.x(), surface.side.y(), 0.0).normalized();
  const double a_m = std::hypot(p_m.x(), p_m.y()), b_m = std::hypot(q_m.x(), q_m.y());
  const double p_rad = angle_from_side(side, p_m), q_rad = angle_from_side(side, q_m);
  const double sense = q_rad >= p_rad ? 1.0 : -1.0;
  const double to_start_rad = std::acos(std::min(1.0, radius_m / a_m));
  const double to_end_rad = std::acos(std::min(1.0, radius_m / b_m));
  const double arc_rad = std::abs(q_rad - p_rad) - to_start_rad - to_end_rad;
  if (!(arc_rad > 0.0)) return std::nullopt;

  const double p_tangent_m = a_m * std::sin(to_start_rad), q_tangent_m = b_m * std::sin(to_end_rad);
  const double planar_m = p_tangent_m + q_tangent_m + radius_m * arc_rad;
  const double rise_m = q_m.z() - p_m.z();
  const double whole_m = std::hypot(planar_m, rise_m);
  Geodesic way;
  way.start_normal = rotated(side, p_rad + sense * to_start_rad);
  way.end_normal = rotated(side, q_rad - sense * to_end_rad);
  way.start_m = radius_m * way.start_normal;
  way.end_m = radius_m * way.end_normal;
  way.start_m.z() = p_m.z() + rise_m * p_tangent_m / planar_m;
  way.end_m.z() = q_m.z() - rise_m * q_tangent_m / planar_m;
  const double around = sense * planar_m / whole_m, along = rise_m / whole_m;
  way.start_direction = around * Vec3::UnitZ().cross(way.start_normal) + along * Vec3::UnitZ();
  way.end_direction = around * Vec3::UnitZ().cross(way.end_normal) + along * Vec3::UnitZ();
  way.length_m = radius_m * arc_rad * whole_m / planar_m;
  way.reach_m = way.length_m;
  return way;
}

Vec3 place_on_cylinder(const Geodesic& way, double arc_m) {
  const Vec3 radial(way.start_m.x(), way.start_m.y(), 0.0);
  const Vec3 tangent = Vec3::UnitZ().cross(way.start_normal);
  const double around_rad = arc_m * way.start_direction.dot(tangent) / radial.norm();
  return std::cos(around_rad) * radial + std::sin(around_rad) * radial.norm() * tangent +
         (way.start_m.z() + arc_m * way.start_direction.z()) * Vec3::UnitZ();
}

}  // namespace myotact::geometry
