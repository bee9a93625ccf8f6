#include "geometry/refine.h"

#include <utility>

namespace myotact::geometry {
namespace {

/// A diagonal of the octahedron between two of the six mid-side nodes, and the other four around it.
struct Diagonal {
  std::size_t from, to;
  std::array<std::size_t, 4> ring;
};
// Mid-side nodes are numbered as in kTetEdges: 01, 12, 02, 03, 13, 23.
constexpr std::array<Diagonal, 3> kDiagonals{{{0, 5, {2, 3, 4, 1}}, {2, 4, {0, 3, 5, 1}}, {3, 1, {0, 2, 5, 4}}}};

const Vec3& node_of(const TetMesh& mesh, int node) {
  return mesh.nodes_m[static_cast<std::size_t>(node)];
}

const Diagonal& shortest_diagonal(const TetMesh& mesh, const std::array<int, 6>& middle) {
  const auto length = [&](const Diagonal& d) {
    return (node_of(mesh, middle[d.from]) - node_of(mesh, middle[d.to])).squaredNorm();
  };
  const Diagonal* best = &kDiagonals[0];
  for (const Diagonal& diagonal : kDiagonals) {
    if (length(diagonal) < length(*best)) best = &diagonal;
  }
  return *best;
}

}  // namespace

TetMesh refine(const TetMesh& linear, std::vector<std::array<int, 2>>* edge_of_added_node) {
  const TetMesh quadratic = make_quadratic(linear, edge_of_added_node);
  TetMesh fine;
  fine.nodes_m = quadratic.nodes_m;
  for (std::size_t t = 0; t < quadratic.corners.size(); ++t) {
    const std::array<int, 4>& c = quadratic.corners[t];
    const std::array<int, 6>& m = quadratic.midsides[t];
    fine.corners.push_back({c[0], m[0], m[2], m[3]});
    fine.corners.push_back({m[0], c[1], m[1], m[4]});
    fine.corners.push_back({m[2], m[1], c[2], m[5]});
    fine.corners.push_back({m[3], m[4], m[5], c[3]});
    const Diagonal& diagonal = shortest_diagonal(quadratic, m);
    for (std::size_t k = 0; k < 4; ++k) {
      fine.corners.push_back({m[diagonal.from], m[diagonal.to], m[diagonal.ring[k]], m[diagonal.ring[(k + 1) % 4]]});
      std::array<int, 4>& child = fine.corners.back();
      if (corner_volume_m3(fine, fine.corners.size() - 1) < 0.0) std::swap(child[2], child[3]);
    }
  }
  return fine;
}

}  // namespace myotact::geometry
