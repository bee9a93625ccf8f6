#pragma once

#include "simulation/muscle/muscle_tissue.h"

namespace myotact::simulation {

/// Mesh, elements, masses, clamps, strands and the pattern of one muscle, without contact. `muscle`: index in the
/// specimen. Throws Error BadData naming the muscle when it cannot be simulated: no tets, no line of 2 points, nothing
/// clamped, nothing free, a tet of no volume.
MuscleTissue build_muscle_tissue(const anatomy::Specimen& specimen, int muscle, TissueModel model = TissueModel::Fem);

}  // namespace myotact::simulation
