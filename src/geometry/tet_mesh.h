#pragma once

#include <array>
#include <vector>

#include "core/vector.h"

namespace myotact::geometry {

/// Tetrahedral mesh, linear (4 nodes) or quadratic (10 nodes). Corners 0 1 2 are counter-clockwise seen from corner 3's
/// opposite side, so that det(x1-x0, x2-x0, x3-x0) > 0. Mid-side nodes in VTK's order: edges 01, 12, 02, 03, 13, 23.
struct TetMesh {
  std::vector<Vec3> nodes_m;
  std::vector<std::array<int, 4>> corners;   // m
  std::vector<std::array<int, 6>> midsides;  // m, or empty for a linear mesh

  bool quadratic() const { return !midsides.empty(); }
};

inline constexpr std::array<std::array<int, 2>, 6> kTetEdges = {{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};

/// Signed volume of a tet's corners [m^3].
double corner_volume_m3(const TetMesh& mesh, std::size_t tet);
double total_volume_m3(const TetMesh& mesh);

/// Straight-sided quadratic mesh of a linear one. The first nodes are the linear mesh's, in its order; each mid-side
/// node follows with `edge_of_node` (if given) receiving the two corner nodes it lies between.
TetMesh make_quadratic(const TetMesh& linear, std::vector<std::array<int, 2>>* edge_of_added_node = nullptr);

}  // namespace myotact::geometry
