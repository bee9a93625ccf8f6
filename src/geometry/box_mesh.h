#pragma once

#include <array>

#include "geometry/tet_mesh.h"

namespace myotact::geometry {

/// How the cells of a box lie: mirror images of their neighbours, so that the mesh has no sideways preference, or all
/// alike.
enum class BoxCells { Mirrored, Alike };

/// Linear tets of a box from the origin to `size_m`: six to a cell (Kuhn's), cell after cell, z fastest. Sizes and
/// counts must be > 0.
TetMesh make_box_mesh(const Vec3& size_m, const std::array<int, 3>& cells, BoxCells kind = BoxCells::Mirrored);

inline constexpr int kTetsOfBoxCell = 6;

}  // namespace myotact::geometry
