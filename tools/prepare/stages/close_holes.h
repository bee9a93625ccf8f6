#pragma once

#include "geometry/triangle_mesh.h"

namespace myotact::prepare {

/// A muscle as thin as the lattice that it was cut from is often torn: a neighbour that the lattice has not the room to
/// part from it reaches through. The skin with what is narrower than some steps filled: what is left of it when it is
/// moved out by so much and back (a morphological closing), in larger triangles again. The skin as it is where it has
/// no handle, is thicker than some steps, or where filling does not leave fewer handles, one piece and its volume.
/// Closed, manifold, outward, no crossings, before and after; [m].
geometry::TriangleMesh close_holes(const geometry::TriangleMesh& skin, double step_m);

}  // namespace myotact::prepare
