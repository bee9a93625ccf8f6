#pragma once

#include <utility>
#include <vector>

#include "geometry/triangle_mesh.h"

namespace myotact::prepare {

/// Pairs of triangles that cross each other, or that touch without sharing a corner or an edge, and no more than `most`
/// of them: a heap of random triangles has millions. Exact predicates. Manifold mesh.
std::vector<std::pair<int, int>> crossing_triangles(const geometry::TriangleMesh& mesh, unsigned most = 1'000'000);

}  // namespace myotact::prepare
