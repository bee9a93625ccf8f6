#pragma once

#include "prepare/remesh/guarded_mesh.h"

namespace myotact::prepare {

/// Makes triangles more even without changing the surface beyond the mesh's tolerance: long edges are split, edges
/// flipped where that widens the narrowest angle, vertices moved along the surface towards the middle of their
/// neighbours and back onto the reference, `rounds` times. `edge_m` is the wanted length.
void even_out(GuardedMesh& guarded, double edge_m, int rounds);

}  // namespace myotact::prepare
