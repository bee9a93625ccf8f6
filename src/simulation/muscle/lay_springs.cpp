#include "simulation/muscle/lay_springs.h"

#include <algorithm>
#include <cmath>

namespace myotact::simulation {
namespace {

/// Each edge's length, and the stiffness that the tet adds to it.
void set_edges(const MuscleTissue& tissue, const TissueElement& element, std::size_t lane, EdgeSprings& edges) {
  const double shear_Pa = (element.sheath ? kTendonSheath : kMuscleMatrix).matrix.shear_Pa;
  for (std::size_t e = 0; e < kTetEdgeCount; ++e) {
    const auto [a, b] = edge_nodes(e);
    const std::vector<Vec3>& nodes = tissue.mesh.nodes_m;
    const double squared_m2 =
        (nodes[static_cast<std::size_t>(element.nodes[a])] - nodes[static_cast<std::size_t>(element.nodes[b])])
            .squaredNorm();
    edges.length_m[e].lane[lane] = std::sqrt(squared_m2);
    edges.stiffness_N_m[e].lane[lane] = kSpringScale * 2.5 * shear_Pa * element.shape.volume_m3 / squared_m2;
  }
}

}  // namespace

std::vector<SpringBatch> lay_springs(const MuscleTissue& tissue) {
  std::vector<SpringBatch> net;
  for (std::size_t t = 0; t < tissue.elements.size(); ++t) {
    if (net.empty() || net.back().tets.count == kBatch) net.emplace_back();
    TetBatch<LinearTet>& tets = net.back().tets;
    const TissueElement& element = tissue.elements[t];
    const std::size_t lane = static_cast<std::size_t>(tets.count++);
    std::array<int, LinearTet::kNodes> corners{};
    std::copy(element.nodes.begin(), element.nodes.end(), corners.begin());
    set_lane(tets, lane, static_cast<int>(t), element.shape, corners);
    set_slots<LinearTet>(tissue.pattern, free_nodes(tissue, corners), lane, tets.slots);
    set_edges(tissue, element, lane, net.back().edges);
  }
  return net;
}

}  // namespace myotact::simulation
