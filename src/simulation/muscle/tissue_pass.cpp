#include "simulation/muscle/tissue_pass.h"

namespace myotact::simulation {

TissueState make_state(const MuscleTissue& tissue) {
  TissueFrame frame;
  const auto dofs = static_cast<Eigen::Index>(3 * tissue.mesh.nodes_m.size());
  frame.position_m.resize(dofs);
  for (std::size_t node = 0; node < tissue.mesh.nodes_m.size(); ++node) {
    frame.position_m.segment<3>(static_cast<Eigen::Index>(3 * node)) = tissue.mesh.nodes_m[node];
  }
  frame.velocity_m_s = Eigen::VectorXd::Zero(dofs);
  frame.stretch.assign(tissue.elements.size() * tissue.elements.front().points(), 1.0);
  return {frame, frame, frame, std::vector<double>(frame.stretch.size(), 0.0), 0.0, {}, {}};
}

void place_clamped(const MuscleTissue& tissue, const Skeleton& skeleton, TissueState& state) {
  for (std::size_t node = 0; node < tissue.body.size(); ++node) {
    if (tissue.body[node] < 0) continue;
    state.now.position_m.segment<3>(static_cast<Eigen::Index>(3 * node)) =
        skeleton.body_pose(tissue.body[node]) * tissue.mesh.nodes_m[node];
  }
}

}  // namespace myotact::simulation
