#pragma once

#include "measure/validation/kinds.h"

namespace myotact::measure {

/// A box that starts at rest length with velocities and moves without load or loss. Inputs of both: size_m, cells,
/// element, laws, density_kg_m3, rule (backward_euler, second_order), dt_s, held (at x = 0, or nowhere), stretching_1_s
/// (velocity along x over x), spin_1_s (about z), velocity_m_s.

/// Also end_s and halvings (2 .. 8) of the step. Quantities: order, from the last three end positions; error, the last
/// two's difference over the way; residual, the largest.
Quantities solid_order(JsonObject& inputs);

/// Also end_s. Quantities: momentum_drift, the largest change in one step over the momentum at the start;
/// angular_momentum_kept, about the centre of mass, its length over that at the start, at the end; energy_gain, the
/// largest energy after the start over that at the start, less 1; energy_kept, at the end over that at the start;
/// failed_steps.
Quantities solid_conservation(JsonObject& inputs);

}  // namespace myotact::measure
