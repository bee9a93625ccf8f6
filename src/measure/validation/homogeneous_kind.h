#pragma once

#include "measure/validation/kinds.h"

namespace myotact::measure {

/// A box between three planes of symmetry in a state that is the same everywhere, found by the finite-element solver.
/// Inputs: laws; element; size_m, cells; fibre (along x); activation (0); state and its places:
///   uniaxial     stretches   the face at the far end of x moves, the sides are free
///   equibiaxial  stretches   the faces at the far ends of x and y move
///   simple_shear shears      the surface moves along x in proportion to y
///   contraction  activations nothing is held but the planes
/// Quantities at each place: stretch, lateral (stretch along z), J; cauchy_Pa (11), shear_Pa (12),
/// normal_difference_Pa (11 less 22); nominal_Pa, the support's force along x over the section at rest, and force_N;
/// spread, the largest difference of a tet's Cauchy stress over the stress; displacement_norm_m, of all components that
/// are free.
Quantities homogeneous_state(JsonObject& inputs);

}  // namespace myotact::measure
