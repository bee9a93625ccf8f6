#pragma once

#include "measure/validation/kinds.h"

namespace myotact::measure {

/// A box held at x = 0 with a small force in z on the face at its other end, static. Inputs: size_m, law (elastic),
/// young_Pa, poissons (a list), force_N, element, meshes (a list of cells), mirrored (true), shear_coefficient (5/6).
/// Quantities by Poisson's ratio: ratio_AxBxC(nu), the end's deflection over Timoshenko's P L^3 / 3 E I + P L / k G A;
/// order(nu), at which 1 - ratio falls with the cells along z, least squares over the
/// meshes; spread_AxBxC, the largest ratio over the smallest of all Poisson's ratios, less 1.
Quantities cantilever(JsonObject& inputs);

/// The lowest free vibration of a box held at x = 0, from its stiffness at rest and its lumped mass by inverse
/// iteration. Inputs: size_m, cells, law, young_Pa, poisson, density_kg_m3, element. Quantities: frequency_hz;
/// euler_bernoulli_hz, of a thin beam bending about its weaker axis; converged.
Quantities beam_vibration(JsonObject& inputs);

/// A box held at x = 0 under its own weight, static, large deflection. Inputs: size_m, cells, law, young_Pa, poisson,
/// density_kg_m3, gravity_m_s2, element; reference (may be left out): {cells, element, fluctuation_over_shear}.
/// Quantities: tip_m, mean of the end face along z; tets; with a reference reference_tip_m and tip_ratio.
Quantities hanging_beam(JsonObject& inputs);

}  // namespace myotact::measure
