#pragma once

#include "simulation/muscle/tissue_pass.h"

namespace myotact::simulation {

/// Adds the forces of contact with bones to the nodes and its torques to the joints, and their slopes if the pass wants
/// a tangent. Reads and writes the pass's own muscle only.
void add_bone_contact(const TissuePass& pass);

}  // namespace myotact::simulation
