#pragma once

#include "simulation/muscle/tissue_pass.h"

namespace myotact::simulation {

/// Zero, sized for the muscle and the skeleton's joints; the pattern is analysed for its factor.
TissueSystem make_system(const MuscleTissue& tissue, const Skeleton& skeleton);

/// Forces, residual and torques of the present iterate; stores its stretches in `state.now`, and its velocities unless
/// the load is static.
void compute_forces(const MuscleTissue& tissue, const Skeleton& skeleton, const TissueLoad& load, TissueState& state,
                    TissueSystem& system);
/// The same and the tangent, which goes to the factor's places when the load sets `in_factor`, else to the matrix; it
/// is not factored. Different muscles may be computed by different threads at once.
void compute_system(const MuscleTissue& tissue, const Skeleton& skeleton, const TissueLoad& load, TissueState& state,
                    TissueSystem& system);

}  // namespace myotact::simulation
