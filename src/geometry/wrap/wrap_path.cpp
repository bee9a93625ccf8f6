#include "geometry/wrap/wrap_path.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "geometry/wrap/geodesic.h"

namespace myotact::geometry {
namespace {

/// Ends are kept this part of the radius above the surface: below, the direction of the tangent is lost in rounding.
constexpr double kHover = 1e-8;
/// Least distance between conjugate ends [of the string's length]: there a string over half a sphere can slide
/// anywhere.
constexpr double kLeastReach = 1e-6;

/// An end of the string, outside the surface.
struct OutsideEnd {
  Vec3 p_m;
  Mat3 by_given = Mat3::Identity();  // derivative by the end that was given
  bool moved = false;
};

/// The part of a vector that counts for the distance from the centre or axis, in radii.
Vec3 in_radii(const WrapSurface& surface, const Vec3& p_m) {
  Vec3 scaled = p_m.cwiseQuotient(surface.radii_m);
  if (surface.shape == WrapShape::Cylinder) scaled.z() = 0.0;
  return scaled;
}

OutsideEnd outside_end(const WrapSurface& surface, const Vec3& p_m) {
  Vec3 scaled = in_radii(surface, p_m);
  const double distance = scaled.norm();
  if (distance >= 1.0 + kHover) return {p_m};
  const bool at_centre = distance < kHover;
  if (at_centre) scaled = in_radii(surface, surface.side);
  const double far = scaled.norm();
  const Vec3 radial = scaled.cwiseProduct(surface.radii_m) * ((1.0 + kHover) / far);
  OutsideEnd end{radial, Mat3::Zero(), true};
  if (!at_centre) {
    end.by_given.diagonal().setConstant((1.0 + kHover) / far);
    end.by_given -= radial * scaled.cwiseQuotient(surface.radii_m).transpose() / (far * far);
  }
  if (surface.shape == WrapShape::Cylinder) {
    end.p_m.z() = p_m.z();
    end.by_given.row(2) = Vec3::UnitZ().transpose();
  }
  return end;
}

std::optional<Geodesic> geodesic_on(const WrapSurface& surface, const Vec3& p_m, const Vec3& q_m) {
  switch (surface.shape) {
    case WrapShape::Cylinder:
      return geodesic_on_cylinder(surface, p_m, q_m);
    case WrapShape::Sphere:
      return geodesic_on_sphere(surface, p_m, q_m);
    case WrapShape::Ellipsoid:
      return geodesic_on_ellipsoid(surface, p_m, q_m);
  }
  return std::nullopt;
}

Vec3 place_on_way(const WrapSurface& surface, const Geodesic& way, double arc_m) {
  if (surface.shape == WrapShape::Cylinder) return place_on_cylinder(way, arc_m);
  if (surface.shape == WrapShape::Sphere) return place_on_sphere(way, arc_m);
  return place_on_ellipsoid(surface, way, arc_m);
}

WrapPath straight_path(const Vec3& p_m, const Vec3& q_m) {
  WrapPath path;
  path.length_m = (q_m - p_m).norm();
  if (path.length_m == 0.0) return path;
  const Vec3 t = (q_m - p_m) / path.length_m;
  path.slope_p = -t;
  path.slope_q = t;
  path.bend_pp_1_m = path.bend_qq_1_m = (Mat3::Identity() - t * t.transpose()) / path.length_m;
  path.bend_pq_1_m = -path.bend_pp_1_m;
  return path;
}

// A small move of an end across the string rotates its straight part: in the direction of the normal about the point
// where it touches; sideways, so that the neighbouring string (start shifted by a, rotated by (a - move)/l_P) still
// meets the other end. With the fields C, C' (spread) and D, D' (reach) of Geodesic and the straight lengths l_P and
// l_Q, that other end would be missed by G = D + l_Q D' + l_P C + l_P l_Q C' for a rotation by 1 at p, hence the terms
// below; they are symmetric since C D' - C' D = 1.
WrapPath bent_path(const Geodesic& way, const Vec3& p_m, const Vec3& q_m) {
  WrapPath path;
  const double p_straight_m = (way.start_m - p_m).norm(), q_straight_m = (q_m - way.end_m).norm();
  path.length_m = p_straight_m + way.length_m + q_straight_m;
  path.wrapped = true;
  path.clears = way.holds;
  path.slope_p = -way.start_direction;
  path.slope_q = way.end_direction;
  double reach_m = way.reach_m + q_straight_m * way.reach_rate + p_straight_m * way.spread +
                   p_straight_m * q_straight_m * way.spread_rate_1_m;
  const double least_m = kLeastReach * path.length_m;
  if (std::abs(reach_m) < least_m) reach_m = std::copysign(least_m, reach_m);
  const Vec3 p_side = way.start_normal.cross(way.start_direction), q_side = way.end_normal.cross(way.end_direction);
  path.bend_pp_1_m = way.start_normal * way.start_normal.transpose() / p_straight_m +
                     (way.spread + q_straight_m * way.spread_rate_1_m) / reach_m * p_side * p_side.transpose();
  path.bend_qq_1_m = way.end_normal * way.end_normal.transpose() / q_straight_m +
                     (way.reach_rate + p_straight_m * way.spread_rate_1_m) / reach_m * q_side * q_side.transpose();
  path.bend_pq_1_m = -p_side * q_side.transpose() / reach_m;
  return path;
}

}  // namespace

WrapPath wrap_path(const WrapSurface& surface, const Vec3& p_m, const Vec3& q_m) {
  const OutsideEnd p = outside_end(surface, p_m), q = outside_end(surface, q_m);
  const auto way = geodesic_on(surface, p.p_m, q.p_m);
  WrapPath path = way ? bent_path(*way, p.p_m, q.p_m) : straight_path(p.p_m, q.p_m);
  if (!p.moved && !q.moved) return path;
  path.clears = !is_inside(surface, p_m) && !is_inside(surface, q_m) && path.clears;
  path.slope_p = p.by_given.transpose() * path.slope_p;
  path.slope_q = q.by_given.transpose() * path.slope_q;
  path.bend_pp_1_m = p.by_given.transpose() * path.bend_pp_1_m * p.by_given;
  path.bend_pq_1_m = p.by_given.transpose() * path.bend_pq_1_m * q.by_given;
  path.bend_qq_1_m = q.by_given.transpose() * path.bend_qq_1_m * q.by_given;
  return path;
}

void wrap_points(const WrapSurface& surface, const Vec3& p_m, const Vec3& q_m, std::span<Vec3> points_m) {
  const Vec3 p = outside_end(surface, p_m).p_m, q = outside_end(surface, q_m).p_m;
  const auto way = geodesic_on(surface, p, q);
  const double before_m = way ? (way->start_m - p).norm() : (q - p).norm();
  const double on_m = way ? way->length_m : 0.0;
  const double after_m = way ? (q - way->end_m).norm() : 0.0;
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    const double share = static_cast<double>(i + 1) / static_cast<double>(points_m.size() + 1);
    const double arc_m = share * (before_m + on_m + after_m);
    if (!way) {
      points_m[i] = p + share * (q - p);
    } else if (arc_m <= before_m) {
      points_m[i] = p + arc_m * way->start_direction;
    } else if (arc_m <= before_m + on_m) {
      points_m[i] = place_on_way(surface, *way, arc_m - before_m);
    } else {
      points_m[i] = q - (before_m + on_m + after_m - arc_m) * way->end_direction;
    }
  }
}

bool is_inside(const WrapSurface& surface, const Vec3& p_m) {
  return in_radii(surface, p_m).squaredNorm() < 1.0;
}

}  // namespace myotact::geometry
