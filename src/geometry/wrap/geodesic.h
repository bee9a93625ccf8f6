#pragma once

#include <optional>

#include "core/vector.h"
#include "geometry/wrap/wrap_path.h"

// The part of a wrapped string that lies on the surface, one shape a file. The ends p and q lie outside.

namespace myotact::geometry {

/// A geodesic from where the string comes on to where it leaves.
struct Geodesic {
  Vec3 start_m = Vec3::Zero(), end_m = Vec3::Zero();
  Vec3 start_direction = Vec3::Zero(), end_direction = Vec3::Zero();  // unit, along the string from p to q
  Vec3 start_normal = Vec3::Zero(), end_normal = Vec3::Zero();        // unit, outward
  double length_m = 0.0;
  /// How neighbouring geodesics part (Jacobi fields): a start shifted sideways by a and rotated by b ends up shifted by
  /// a spread + b reach_m and rotated by a spread_rate_1_m + b reach_rate.
  double spread = 1.0, spread_rate_1_m = 0.0, reach_m = 0.0, reach_rate = 1.0;
  double time = 0.0;  // of an ellipsoid: what the way takes, as its source counts time
  bool holds = true;  // false: more than half round, or the search did not converge and this is the best so far
};

/// Nothing when the string is straight.
std::optional<Geodesic> geodesic_on_cylinder(const WrapSurface& surface, const Vec3& p_m, const Vec3& q_m);
std::optional<Geodesic> geodesic_on_sphere(const WrapSurface& surface, const Vec3& p_m, const Vec3& q_m);
std::optional<Geodesic> geodesic_on_ellipsoid(const WrapSurface& surface, const Vec3& p_m, const Vec3& q_m);

/// The place on the way at `arc_m` from its start.
Vec3 place_on_cylinder(const Geodesic& way, double arc_m);
Vec3 place_on_sphere(const Geodesic& way, double arc_m);
Vec3 place_on_ellipsoid(const WrapSurface& surface, const Geodesic& way, double arc_m);

}  // namespace myotact::geometry
