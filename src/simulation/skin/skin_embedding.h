#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "geometry/tet_mesh.h"
#include "geometry/triangle_mesh.h"

namespace myotact::simulation {

/// A point as a weighted sum of nodes: of its tet, 4 for a linear mesh and 10 for a quadratic one, or of those around
/// it (smooth_embedding.h). Weights sum to 1.
struct NodeWeights {
  static constexpr std::size_t kMostNodes = 40;  // 30 around a point, and ten of its tet
  int tet = -1;                                  // of the mesh, that the point lies in or next to
  int count = 0;                                 // nodes in use
  std::array<int, kMostNodes> nodes{};
  std::array<double, kMostNodes> weights{};
};

/// Shape values of a tet at barycentric coordinates (corners' order; any sign, sum 1): quadratic if the mesh is.
/// Indices are not checked.
NodeWeights shape_weights(const geometry::TetMesh& tets, int tet, const std::array<double, 4>& barycentric);

/// A skin that follows a tet mesh.
struct SkinEmbedding {
  std::vector<NodeWeights> vertices;  // one a skin vertex
  int outside_count = 0;              // vertices outside every tet: extrapolated from the nearest one
  int clamped_count = 0;              // of these, how many lie too far and were pulled in
  double farthest_m = 0.0;            // largest distance of an outside vertex from the tets
};

/// A vertex may lie outside its tet until a barycentric coordinate falls to minus this; then it is pulled in towards
/// the tet. Half a tet's height: larger, and bending the tissue would swing the vertex more than the tissue itself
/// moves.
inline constexpr double kLargestOvershoot = 0.5;

/// Finds for each vertex the tet that contains it, else the nearest. `tets` in its rest shape, quadratic tets
/// straight-sided. Outside, the shape functions go on as their tangent at the nearest point of the tet (a quadratic
/// extrapolation would amplify every wiggle of the mid-side nodes). Throws Error BadData when there is no tet.
SkinEmbedding embed_skin(const geometry::TriangleMesh& skin, const geometry::TetMesh& tets);

/// positions_m[i] = sum of weights * nodes_m; one node and one vertex each, as embedded; `nodes_m` in any frame.
/// Real-time safe.
void update_skin(const SkinEmbedding& embedding, std::span<const Vec3> nodes_m, std::span<Vec3> positions_m) noexcept;

/// Adds a share of a point's weights to `sum`, which has room for its nodes: each node once. Real-time safe.
template <class Weights>
void add_weights(const NodeWeights& more, double share, Weights& sum) noexcept {
  for (std::size_t i = 0; i < static_cast<std::size_t>(more.count); ++i) {
    const auto end = sum.nodes.begin() + sum.count;
    const auto place = static_cast<std::size_t>(std::find(sum.nodes.begin(), end, more.nodes[i]) - sum.nodes.begin());
    if (place == static_cast<std::size_t>(sum.count)) sum.nodes[static_cast<std::size_t>(sum.count++)] = more.nodes[i];
    sum.weights[place] += share * more.weights[i];
  }
}

/// A point of a skin triangle as a weighted sum of tet nodes, each node once. Weights sum to 1.
struct MaterialPoint {
  int count = 0;  // nodes in use
  std::array<int, 3 * NodeWeights::kMostNodes> nodes{};
  std::array<double, 3 * NodeWeights::kMostNodes> weights{};
};

/// `triangle`: its three skin vertices; `barycentric` of any sign, sum 1. Real-time safe.
MaterialPoint material_point(const SkinEmbedding& embedding, const std::array<int, 3>& triangle,
                             const std::array<double, 3>& barycentric) noexcept;

}  // namespace myotact::simulation
