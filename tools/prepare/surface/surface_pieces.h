#pragma once

#include <vector>

#include "geometry/triangle_mesh.h"

namespace myotact::prepare {

/// The connected pieces of a surface, in the order of their first triangle. Vertices and triangles keep their order.
std::vector<geometry::TriangleMesh> pieces_of(const geometry::TriangleMesh& mesh);

/// The number of its piece for each triangle, in the same order.
std::vector<int> piece_of_triangles(const geometry::TriangleMesh& mesh);

/// Adds the triangles of `part` to `mesh`.
void append(geometry::TriangleMesh& mesh, const geometry::TriangleMesh& part);

}  // namespace myotact::prepare
