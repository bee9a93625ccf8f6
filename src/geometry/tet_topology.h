#pragma once

#include <array>
#include <vector>

#include "geometry/tet_mesh.h"

namespace myotact::geometry {

/// A face that belongs to one tet only.
struct BoundaryTriangle {
  std::array<int, 3> corners{};   // counter-clockwise seen from outside
  std::array<int, 3> midsides{};  // between corners 01, 12, 20; of a quadratic mesh only
};

/// The mesh's surface, in the order of its tets.
std::vector<BoundaryTriangle> boundary_triangles(const TetMesh& mesh);

/// The part that each tet belongs to, counted from 0 in the order of their first tets. Tets that share a node belong
/// together.
std::vector<int> connected_parts(const TetMesh& mesh);
/// The same of tets that share a face: what hangs on the rest by a node or an edge only is a block of its own, and can
/// swing there.
std::vector<int> face_connected_blocks(const TetMesh& mesh);

}  // namespace myotact::geometry
