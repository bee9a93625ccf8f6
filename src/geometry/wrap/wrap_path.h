#pragma once

#include <span>

#include "core/vector.h"

namespace myotact::geometry {

// A taut string from p to q that goes round a smooth surface on a given side: straight, along a geodesic, straight.
//
//            A ___ geodesic ___ B            side
//        t_P /                  \ t_Q          ^
//          p      (surface)       q            |
//
// Everything in the surface's own frame: its centre is the origin, its axes are the coordinate axes. All functions are
// pure and allocate nothing.

enum class WrapShape { Cylinder, Sphere, Ellipsoid };

struct WrapSurface {
  WrapShape shape = WrapShape::Cylinder;
  Vec3 radii_m = Vec3::Ones();  // cylinder: about z, without ends, radii_m[2] is not used; sphere: all the same
  Vec3 side = Vec3::UnitX();    // unit, from the centre; of a cylinder not along z
};

/// Largest radius of an ellipsoid over its smallest: up to there the search for the geodesic was tried.
inline constexpr double kMostElongated = 4.0;

/// Length of the string and its derivatives by its ends p and q.
struct WrapPath {
  double length_m = 0.0;
  Vec3 slope_p = Vec3::Zero(), slope_q = Vec3::Zero();  // dl/dp, dl/dq: unit, away from the string's other end
  Mat3 bend_pp_1_m = Mat3::Zero(), bend_pq_1_m = Mat3::Zero(), bend_qq_1_m = Mat3::Zero();  // second derivatives
  bool wrapped = false;                                                                     // touches the surface
  bool clears = true;  // false: an end lies inside the surface, or no geodesic was found
};

/// The string never crosses the half plane from a cylinder's axis opposite to `side`: a straight segment that passes
/// there, even clear of the surface, goes round on the side all the same, so that length and slope have no step while
/// no end crosses that half plane. Where the straight segment clears the surface on the given side, the string is
/// straight; length and slope go over smoothly, the second derivatives jump. Spheres and ellipsoids: the same in the
/// plane of p, q and the centre. They hold a string while both ends are less than 90 degrees from the side, seen from
/// the centre; one that goes more than half round is balanced and not shortest, would slip off in nature, does so here
/// when an end leaves the plane of the others, and reports that it does not clear. An end inside counts as if it lay on
/// the surface, straight out from the centre: the length stays continuous. Cylinder and sphere in closed form; of an
/// ellipsoid the geodesic is integrated, good to 1e-9 of its length.
WrapPath wrap_path(const WrapSurface& surface, const Vec3& p_m, const Vec3& q_m);

/// Places along the string from p to q, evenly spread by its length: `points_m` lie between the ends.
void wrap_points(const WrapSurface& surface, const Vec3& p_m, const Vec3& q_m, std::span<Vec3> points_m);

/// Whether the point lies inside the surface.
bool is_inside(const WrapSurface& surface, const Vec3& p_m);

}  // namespace myotact::geometry
