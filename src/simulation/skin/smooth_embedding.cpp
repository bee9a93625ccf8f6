#include "simulation/skin/smooth_embedding.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/LU>

#include "core/at.h"

namespace myotact::simulation {
namespace {

/// Nodes that a vertex follows: a ball of five node spacings across, half of it outside the muscle.
constexpr std::size_t kFollowed = 30;
/// Of the kernel's reach h [m]: up to the first, half of a force enters within 7 mm of the vertex, as under a
/// fingertip; from the second on the tets alone count. A block with nodes 10 mm apart (h 23 mm) read 815 N/m instead of
/// 350.
constexpr double kFingertip_m = 14e-3, kTooWide_m = 20e-3;
/// A vertex whose weights would be larger lies beside its nodes rather than among them: it would swing farther than the
/// tissue does.
constexpr double kLargestWeight = 1.5;
/// A vertex farther from where its tet has it was pulled in [m].
constexpr double kInPlace_m = 1e-6;

/// The nodes of a tet, of the tets beside it, and so on until there are more than a vertex follows.
class NodesAround {
 public:
  explicit NodesAround(const geometry::TetMesh& tets)
      : tets_(tets), tets_of_(tets.nodes_m.size()), known_(tets.corners.size()) {
    for (std::size_t t = 0; t < tets.corners.size(); ++t) {
      for (const int corner : tets.corners[t]) tets_of_[at(corner)].push_back(static_cast<int>(t));
    }
  }

  /// By their numbers. Searched once a tet: many vertices lie in one.
  const std::vector<int>& of(int tet) {
    std::vector<int>& nodes = known_[at(tet)];
    if (nodes.empty()) nodes = search(tet);
    return nodes;
  }

 private:
  std::vector<int> search(int tet) const {
    std::vector<int> near = {tet}, nodes = nodes_of(near);
    while (nodes.size() <= kFollowed) {
      std::vector<int> wider;
      for (const int t : near) {
        for (const int corner : tets_.corners[at(t)]) {
          const std::vector<int>& beside = tets_of_[at(corner)];
          wider.insert(wider.end(), beside.begin(), beside.end());
        }
      }
      sort_unique(wider);
      if (wider.size() == near.size()) break;  // that is the whole mesh
      near = std::move(wider);
      nodes = nodes_of(near);
    }
    return nodes;
  }
  std::vector<int> nodes_of(const std::vector<int>& tets) const {
    std::vector<int> nodes;
    for (const int t : tets) {
      nodes.insert(nodes.end(), tets_.corners[at(t)].begin(), tets_.corners[at(t)].end());
      nodes.insert(nodes.end(), tets_.midsides[at(t)].begin(), tets_.midsides[at(t)].end());
    }
    sort_unique(nodes);
    return nodes;
  }
  static void sort_unique(std::vector<int>& numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  }

  const geometry::TetMesh& tets_;
  std::vector<std::vector<int>> tets_of_;  // one list a corner node
  std::vector<std::vector<int>> known_;    // one a tet; empty: not searched yet
};

/// A node and its distance from the vertex.
using NearNode = std::pair<double, int>;

/// Weights of the nearest nodes, and where their kernel ends.
struct Smooth {
  NodeWeights weights;  // count 0: there are none
  double reach_m = 0.0;
};

/// The node after the nearest ones is where the kernel ends.
Smooth least_squares_weights(const geometry::TetMesh& tets, const std::vector<int>& nodes, const Vec3& p) {
  if (nodes.size() <= kFollowed) return {};
  std::vector<NearNode> near;
  near.reserve(nodes.size());
  for (const int node : nodes) near.emplace_back((tets.nodes_m[at(node)] - p).norm(), node);
  std::nth_element(near.begin(), near.begin() + kFollowed, near.end());
  const double reach_m = near[kFollowed].first;
  std::sort(near.begin(), near.begin() + kFollowed);
  Eigen::Matrix4d moments = Eigen::Matrix4d::Zero();
  std::array<Eigen::Vector4d, kFollowed> places;  // of each node from the vertex, over the reach
  std::array<double, kFollowed> kernel{};
  for (std::size_t i = 0; i < kFollowed; ++i) {
    const auto& [distance_m, node] = near[i];
    const double inside = 1.0 - distance_m * distance_m / (reach_m * reach_m);
    kernel[i] = inside * inside;
    places[i] << 1.0, (tets.nodes_m[at(node)] - p) / reach_m;
    moments += kernel[i] * places[i] * places[i].transpose();
  }
  const Eigen::Vector4d at_vertex = moments.inverse().col(0);
  NodeWeights result;
  for (std::size_t i = 0; i < kFollowed; ++i) {
    result.nodes[i] = near[i].second;
    result.weights[i] = kernel[i] * places[i].dot(at_vertex);
    if (!(std::abs(result.weights[i]) <= kLargestWeight)) return {};
  }
  result.count = static_cast<int>(kFollowed);
  return {result, reach_m};
}

Vec3 place_of(const NodeWeights& vertex, const geometry::TetMesh& tets) {
  Vec3 place_m = Vec3::Zero();
  for (std::size_t i = 0; i < at(vertex.count); ++i) place_m += vertex.weights[i] * tets.nodes_m[at(vertex.nodes[i])];
  return place_m;
}

}  // namespace

void smooth_embedding(const geometry::TriangleMesh& skin, const geometry::TetMesh& tets, SkinEmbedding& embedding) {
  if (!tets.quadratic()) return;
  NodesAround around(tets);
  for (std::size_t v = 0; v < embedding.vertices.size(); ++v) {
    NodeWeights& vertex = embedding.vertices[v];
    const Vec3& p = skin.positions_m[v];
    if ((place_of(vertex, tets) - p).norm() > kInPlace_m) continue;
    const Smooth smooth = least_squares_weights(tets, around.of(vertex.tet), p);
    const double share = std::clamp((kTooWide_m - smooth.reach_m) / (kTooWide_m - kFingertip_m), 0.0, 1.0);
    if (smooth.weights.count == 0 || share == 0.0) continue;
    NodeWeights both;
    both.tet = vertex.tet;
    add_weights(smooth.weights, share, both);
    if (share < 1.0) add_weights(vertex, 1.0 - share, both);
    vertex = both;
  }
}

}  // namespace myotact::simulation
