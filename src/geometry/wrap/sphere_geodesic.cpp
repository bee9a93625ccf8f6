#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "geometry/wrap/geodesic.h"

namespace myotact::geometry {
namespace {

/// Below this sine of the angle between p and q their plane is lost in rounding.
constexpr double kLeastSine = 1e-12;

/// The plane in which the string runs: a rotation by angle_rad about the normal takes the direction of p to that of q.
struct Rotation {
  Vec3 normal = Vec3::UnitZ();
  double angle_rad = 0.0;  // 0 .. 2 pi
};

Rotation rotation_on_side(const Vec3& side, const Vec3& p, const Vec3& q) {
  const Vec3 across = p.cross(q);
  const double sine = across.norm(), cosine = p.dot(q);
  if (sine <= kLeastSine) {
    if (cosine > 0.0) return {};
    // Straight opposite: any plane will do, so the one that holds the side.
    const Vec3 over = p.cross(side).norm() > kLeastSine ? p.cross(side) : p.unitOrthogonal();
    return {over.normalized(), std::numbers::pi};
  }
  const Vec3 normal = across / sine;
  const double angle_rad = std::atan2(sine, cosine);
  const bool behind = p.cross(side).dot(normal) < 0.0 && side.cross(q).dot(normal) < 0.0;
  if (behind) return {-normal, 2.0 * std::numbers::pi - angle_rad};
  return {normal, angle_rad};
}

}  // namespace

// In the plane of p, q and the centre: two tangents and the arc of a great circle.
std::optional<Geodesic> geodesic_on_sphere(const WrapSurface& surface, const Vec3& p_m, const Vec3& q_m) {
  const double radius_m = surface.radii_m[0];
  const double a_m = p_m.norm(), b_m = q_m.norm();
  const Vec3 p = p_m / a_m, q = q_m / b_m;
  const Rotation rotation = rotation_on_side(surface.side, p, q);
  const double to_start_rad = std::acos(std::min(1.0, radius_m / a_m));
  const double to_end_rad = std::acos(std::min(1.0, radius_m / b_m));
  const double arc_rad = rotation.angle_rad - to_start_rad - to_end_rad;
  if (!(arc_rad > 0.0)) return std::nullopt;

  Geodesic way;
  way.start_normal = std::cos(to_start_rad) * p + std::sin(to_start_rad) * rotation.normal.cross(p);
  way.end_normal = std::cos(to_end_rad) * q - std::sin(to_end_rad) * rotation.normal.cross(q);
  way.start_m = radius_m * way.start_normal;
  way.end_m = radius_m * way.end_normal;
  way.start_direction = rotation.normal.cross(way.start_normal);
  way.end_direction = rotation.normal.cross(way.end_normal);
  way.length_m = radius_m * arc_rad;
  way.spread = way.reach_rate = std::cos(arc_rad);
  way.spread_rate_1_m = -std::sin(arc_rad) / radius_m;
  way.reach_m = radius_m * std::sin(arc_rad);
  way.holds = rotation.angle_rad <= std::numbers::pi;
  return way;
}

Vec3 place_on_sphere(const Geodesic& way, double arc_m) {
  const double radius_m = way.start_m.norm();
  return std::cos(arc_m / radius_m) * way.start_m + std::sin(arc_m / radius_m) * radius_m * way.start_direction;
}

}  // namespace myotact::geometry
