#pragma once

#include <utility>
#include <vector>

#include "geometry/triangle_mesh.h"

namespace myotact::prepare {

/// Pairs of triangles that cross each other, or that touch without sharing a corner or an edge, and no more than `most`
/// of them: a heap of random triangles has millions. Exact predicates. Manifold mesh.
std::vector<std::pair<int, int>> crossing_triangles(const geometry::TriangleMesh& mesh, unsigned most = 1'000'000);

/// Triangles of nearly even size on the same surface: edges are split, collapsed, flipped and smoothed towards
/// `edge_m`, vertices projected back onto the input (Botsch and Kobbelt 2004). The input is closed and manifold. The
/// result shrinks where the surface is curved, and may cross itself where it is thinner than an edge: check it.
geometry::TriangleMesh remesh_evenly(const geometry::TriangleMesh& mesh, double edge_m);

}  // namespace myotact::prepare
