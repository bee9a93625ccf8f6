#pragma once

#include "geometry/tet_mesh.h"

namespace myotact::geometry {

/// Every tet of a linear mesh cut into eight of equal volume at the middles of its edges: four at its corners and four
/// about the shortest diagonal of the octahedron that is left. The children of tet t are 8 t .. 8 t + 7; the first
/// nodes are the mesh's own, then come those that make_quadratic() would add, in its order and returned with the two
/// nodes they lie between.
TetMesh refine(const TetMesh& linear, std::vector<std::array<int, 2>>* edge_of_added_node = nullptr);

}  // namespace myotact::geometry
