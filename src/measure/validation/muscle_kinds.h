#pragma once

#include "measure/validation/kinds.h"

namespace myotact::measure {

/// How far four elements are from the truth on a real muscle. The muscle's own mesh (the cage) carries the quadratic
/// elements; cut in eight it carries the linear ones, which then have the same nodes, and the reference, the quadratic
/// element with a fluctuation term of two shear moduli. Tendon is clamped with its end; where the end is released it
/// has the matrix alone.
/// Inputs: muscle; shear_Pa, poisson of the stable neo-Hookean matrix; peak_Pa of the fibres; activations;
/// shortening_activation; bending_N; press_N. Quantities, errors over the reference, for each element E of linear,
/// patched, quadratic_own (a volume term at each point) and quadratic: E_force(activation), both ends clamped;
/// E_force, the mean of their sizes; E_shortening, the insertion released; E_bending, by a force across it; E_press, by
/// a force across the middle, clamped (both less what the tension at rest moves); also reference_... themselves [N, m],
/// tets and reference_tets.
Quantities muscle_elements(JsonObject& inputs);

}  // namespace myotact::measure
