#pragma once

#include <vector>

#include "core/vector.h"
#include "geometry/triangle_mesh.h"

namespace myotact::prepare {

/// One cross-section as points around it, counter-clockwise seen against the direction of the loft.
using Ring = std::vector<Vec3>;

/// Closed surface through rings of equal size, ended by one point each; triangles outward. Positions are rounded to
/// 1e-7 m, so that libraries' last digits do not decide how it is meshed.
geometry::TriangleMesh join_rings(const std::vector<Ring>& rings, const Vec3& first_tip, const Vec3& last_tip);

}  // namespace myotact::prepare
