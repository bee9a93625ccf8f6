#pragma once

#include <vector>

#include "geometry/tet_mesh.h"

namespace myotact::simulation {

/// Groups tets into patches of about 6 neighbours, all of one material, that do not overlap: fewer patches than nodes,
/// so that one volume constraint a patch does not lock. `material`: one a tet. Returns the patch of each tet; some
/// numbers may be left unused. Deterministic.
std::vector<int> find_patches(const geometry::TetMesh& mesh, const std::vector<int>& material);

}  // namespace myotact::simulation
