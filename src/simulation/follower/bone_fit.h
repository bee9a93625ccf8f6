#pragma once

#include "simulation/follower/bone_gaps.h"
#include "simulation/follower/follower.h"
#include "simulation/skin/skin_embedding.h"

namespace myotact::simulation {

/// What the fit of one follower reads.
struct BoneFitInput {
  const geometry::TetMesh& mesh;       // at rest
  const std::vector<int>& attachment;  // one a node: body, or -1
  const geometry::TriangleMesh& skin;  // at rest
  const SkinEmbedding& embedding;      // of that skin in the mesh
  const BoneSurfaces& bones;
};

/// Fills the follower's tables: at sampled angles of each joint, the others at the file pose, the smoothest
/// displacement after which no vertex of the skin lies deeper in any bone than at the file pose, and none that touched
/// a bone there is farther from all bones. Samples go outwards from the file pose, each from the one before, so that a
/// bone pushes the skin ahead of it instead of passing it. Joints add up: each acts where it bends. A joint that moves
/// no bone against the muscle leaves no table. `skeleton`: a copy is posed. A pure function of its input; takes some
/// tenths of a second.
void fit_to_bones(const BoneFitInput& input, const Skeleton& skeleton, Follower& follower);

}  // namespace myotact::simulation
