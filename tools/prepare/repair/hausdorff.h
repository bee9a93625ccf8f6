#pragma once

#include "geometry/triangle_mesh.h"
#include "prepare/repair/repair_job.h"

namespace myotact::prepare {

/// The largest of two distances, and where it is.
///   repaired -> input: from places of the repaired surface to the input's triangles that belong to the body. Patches
///     over holes do not count: the input has nothing there.
///   input -> repaired: from places of the input's triangles to the repaired surface. What was dropped on purpose does
///     not count (fins, inner walls, specks, floaters, cavities, inner shells), nor, where pieces were united, what
///     lies inside the union.
/// Places are the corners and a grid with half the tolerance as its step on every triangle that is not the same in
/// both; only the corners where they lie so near to one triangle of the other surface that nothing between them is
/// farther. Between places of the grid the distance is larger by 0.6 steps at most.
struct SurfaceMove {
  double distance = 0.0;  // diagonals
  Vec3 place = Vec3::Zero();
};
SurfaceMove measure_move(const RepairJob& job, const geometry::TriangleMesh& raw);

}  // namespace myotact::prepare
