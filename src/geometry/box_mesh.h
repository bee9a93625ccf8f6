#pragma once

#include <array>

#include "geometry/tet_mesh.h"

namespace myotact::geometry {

/// Linear tets of a box from the origin to `size_m`: six to a cell (Kuhn's), cell after cell, z fastest. Neighbouring
/// cells are mirror images of each other, so that the mesh has no sideways preference. Sizes and counts must be > 0.
TetMesh make_box_mesh(const Vec3& size_m, const std::array<int, 3>& cells);

inline constexpr int kTetsOfBoxCell = 6;

}  // namespace myotact::geometry
