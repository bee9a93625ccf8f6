#pragma once

#include "geometry/tet_mesh.h"

namespace myotact::prepare {

/// Moves nodes so that the flattest tets get wider angles: each node of a tet with an angle below 18 degrees is tried
/// in a dozen directions, at ever shorter steps, and keeps the place where the smallest angle around it is largest. The
/// first `surface_nodes` nodes stay within `surface_reach_m` of where they were; no tet is inverted.
void smooth_tets(geometry::TetMesh& mesh, std::size_t surface_nodes, double surface_reach_m);

}  // namespace myotact::prepare
