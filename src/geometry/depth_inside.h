#pragma once

#include <span>

#include "core/vector.h"
#include "geometry/triangle_mesh.h"

namespace myotact::geometry {

/// Solid angle of a triangle seen from the origin [sr], positive where its normal points away from it (Van Oosterom and
/// Strackee, IEEE Trans. Biomed. Eng. 30:125, 1983).
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c);

/// How many times a closed surface whose vertices are at `positions_m` winds round a point: 1 inside, 0 outside. Looks
/// at every triangle: for a few points.
double winding_number(const TriangleMesh& surface, std::span<const Vec3> positions_m, const Vec3& p);

/// How far a point lies below a closed surface, 0 outside. Looks at every triangle: for a few points.
double depth_inside_m(const TriangleMesh& surface, const Vec3& p);

}  // namespace myotact::geometry
