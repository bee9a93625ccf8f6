#pragma once

#include <vector>

#include "geometry/triangle_mesh.h"

namespace myotact::prepare {

/// Fans of triangles that share one vertex, each given by its corners there (3 triangle + corner). Where each of them
/// must have a vertex of its own so that they no longer touch: one stays, the others move along the direction in which
/// their triangles look most alike, into the inside or outside of their own, away from the rest. By at most `farthest`,
/// and a tenth of their shortest edge.
std::vector<Vec3> pulled_apart(const geometry::TriangleMesh& mesh, const std::vector<std::vector<int>>& fans,
                               double farthest);

}  // namespace myotact::prepare
