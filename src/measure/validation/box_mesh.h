#pragma once

#include <array>
#include <vector>

#include "geometry/tet_mesh.h"

namespace myotact::measure {

struct Box {
  Vec3 size_m = Vec3::Ones();
  std::array<int, 3> cells{1, 1, 1};
  bool mirrored = true;  // each cell is the mirror image of its neighbours, so that no direction is favoured
};

/// Its linear tets, with a corner in the origin (geometry/box_mesh.h).
geometry::TetMesh make_box(const Box& box);

/// The cell of each tet: patches of the size that the patched element wants.
std::vector<int> cells_of_box(const geometry::TetMesh& mesh);

/// Moves the nodes inside the box at random by at most `share` of a cell's size along each axis.
void shake_inside(const Box& box, double share, geometry::TetMesh& mesh);

}  // namespace myotact::measure
