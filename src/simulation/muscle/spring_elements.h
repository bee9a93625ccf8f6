#pragma once

#include "simulation/muscle/fibre_field.h"

namespace myotact::simulation {

// The elements of a mass-spring muscle in its equations; the rest of them (strands, masses, clamps) is that of every
// muscle and in tissue_system.

/// Kinematics of all elements at the positions now: stretches into `state.now`, points, volume ratio and smallest J
/// into the system.
void deform_springs(const TissuePass& pass);

/// Forces and, with `pass.tangent`, their slopes and the gradient of the fibres' summed stretch [m^3 Pa / m]. Nothing
/// for a muscle of another model.
void add_springs(const TissuePass& pass, const FibreInputs& fibres);

}  // namespace myotact::simulation
