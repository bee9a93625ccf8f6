#include "prepare/tets/smooth_tets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "prepare/tets/tet_quality.h"

namespace myotact::prepare {

namespace {

/// Tets with a smaller angle are worked on [degrees]; the solver does not notice better ones.
constexpr double kGoodEnough_deg = 18.0;
/// Rounds over all nodes; from the fifth on the worst angle changes by less than a tenth of a degree.
constexpr int kRounds = 6;
/// Steps as parts of the shortest edge at the node.
constexpr std::array<double, 4> kSteps = {0.3, 0.12, 0.05, 0.02};

/// Ways to the faces, edges and corners of a cube.
std::vector<Vec3> directions() {
  std::vector<Vec3> result;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x != 0 || y != 0 || z != 0) result.push_back(Vec3(x, y, z).normalized());
      }
    }
  }
  return result;
}

class Smoother {
 public:
  Smoother(geometry::TetMesh& mesh, std::size_t surface_nodes, double surface_reach_m)
      : mesh_(mesh),
        start_m_(mesh.nodes_m),
        surface_nodes_(surface_nodes),
        surface_reach_m_(surface_reach_m),
        tets_of_node_(mesh.nodes_m.size()) {
    for (std::size_t t = 0; t < mesh.corners.size(); ++t) {
      for (const int n : mesh.corners[t]) tets_of_node_[static_cast<std::size_t>(n)].push_back(t);
    }
  }

  void run() {
    for (int round = 0; round < kRounds; ++round) {
      bool moved = false;
      for (std::size_t n = 0; n < tets_of_node_.size(); ++n) moved |= improve(n);
      if (!moved) return;
    }
  }

 private:
  /// Smallest angle of the tets at a node [degrees]; below zero when one is inside out.
  double worst_deg(std::size_t node) const {
    double worst = 180.0;
    for (const std::size_t t : tets_of_node_[node]) {
      if (geometry::corner_volume_m3(mesh_, t) <= 0.0) return -1.0;
      TetCorners x;
      for (std::size_t k = 0; k < 4; ++k) x[k] = mesh_.nodes_m[static_cast<std::size_t>(mesh_.corners[t][k])];
      const auto angles = dihedrals_deg(x);
      worst = std::min(worst, *std::min_element(angles.begin(), angles.end()));
    }
    return worst;
  }

  double shortest_edge_m(std::size_t node) const {
    double shortest_m = std::numeric_limits<double>::infinity();
    for (const std::size_t t : tets_of_node_[node]) {
      for (const int n : mesh_.corners[t]) {
        if (static_cast<std::size_t>(n) == node) continue;
        const Vec3 edge = mesh_.nodes_m[static_cast<std::size_t>(n)] - mesh_.nodes_m[node];
        shortest_m = std::min(shortest_m, edge.norm());
      }
    }
    return shortest_m;
  }

  bool may_lie_at(std::size_t node, const Vec3& place_m) const {
    return node >= surface_nodes_ || (place_m - start_m_[node]).norm() <= surface_reach_m_;
  }

  bool improve(std::size_t node) {
    double best_deg = worst_deg(node);
    if (best_deg >= kGoodEnough_deg) return false;
    const double edge_m = shortest_edge_m(node);
    bool moved = false;
    for (const double step : kSteps) {
      const Vec3 here_m = mesh_.nodes_m[node];
      Vec3 best_m = here_m;
      for (const Vec3& direction : directions_) {
        const Vec3 place_m = here_m + step * edge_m * direction;
        if (!may_lie_at(node, place_m)) continue;
        mesh_.nodes_m[node] = place_m;
        const double angle_deg = worst_deg(node);
        if (angle_deg > best_deg) best_deg = angle_deg, best_m = place_m, moved = true;
      }
      mesh_.nodes_m[node] = best_m;
    }
    return moved;
  }

  geometry::TetMesh& mesh_;
  std::vector<Vec3> start_m_;
  std::size_t surface_nodes_;
  double surface_reach_m_;
  std::vector<std::vector<std::size_t>> tets_of_node_;
  std::vector<Vec3> directions_ = directions();
};

}  // namespace

void smooth_tets(geometry::TetMesh& mesh, std::size_t surface_nodes, double surface_reach_m) {
  Smoother(mesh, surface_nodes, surface_reach_m).run();
}

}  // namespace myotact::prepare
