#pragma once

#include <vector>

#include "core/vector.h"
#include "geometry/triangle_mesh.h"

namespace myotact::prepare {

/// Centres of all triangles and middles of all edges (closed mesh), in the triangles' order.
std::vector<Vec3> places_within_triangles_m(const geometry::TriangleMesh& mesh);

/// How far two surfaces lie apart.
struct SurfaceDistance {
  double largest_m = 0.0;  // Hausdorff distance at samples
  Vec3 place_m = Vec3::Zero();
};

/// Looks both ways, from the vertices, the middles of edges and the centres of triangles of one to the nearest place on
/// the other.
SurfaceDistance surface_distance(const geometry::TriangleMesh& a, const geometry::TriangleMesh& b);

/// The same from the first to the second only.
SurfaceDistance one_way_distance(const geometry::TriangleMesh& from, const geometry::TriangleMesh& to);

}  // namespace myotact::prepare
