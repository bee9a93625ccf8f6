#pragma once

#include <array>
#include <vector>

#include "core/vector.h"

namespace myotact::geometry {

/// Closed or open triangle surface. Triangles are counter-clockwise seen from outside.
struct TriangleMesh {
  std::vector<Vec3> positions_m;              // n
  std::vector<std::array<int, 3>> triangles;  // m, indices into positions_m
};

/// Signed volume enclosed, positive when triangles face outward [m^3]. Meaningful for closed meshes only.
double enclosed_volume_m3(const TriangleMesh& mesh);
double surface_area_m2(const TriangleMesh& mesh);

/// Area-weighted unit normals, one a vertex; (0,0,1) where no triangle has area.
std::vector<Vec3> vertex_normals(const TriangleMesh& mesh);

/// Number of edges that do not have exactly one triangle on each side. 0: closed, manifold and consistently oriented.
int bad_edge_count(const TriangleMesh& mesh);

}  // namespace myotact::geometry
