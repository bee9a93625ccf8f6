#pragma once

#include <functional>

#include "geometry/triangle_mesh.h"

namespace myotact::testing {

/// The outer faces of the cubes of a lattice, two triangles each, corners shared: what a naive cuberille makes of
/// voxels. Cubes that touch along an edge give an edge with four triangles.
geometry::TriangleMesh cuberille(int counts, double step_m, const std::function<bool(int, int, int)>& is_inside);

}  // namespace myotact::testing
