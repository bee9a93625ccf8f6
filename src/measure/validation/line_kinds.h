#pragma once

#include "measure/validation/kinds.h"

namespace myotact::measure {

// Kinds of line models. *Model* stands for: model (the name of a line model in assets/cases/), tendon (rigid or
// elastic; left out: the model's), q_rad (left out: the model's first), all_driven (false).

/// Inputs: model, levels, stretch (fibre length over the optimal one, of every muscle at q = 0; left out: the model's).
/// Quantities by level: the columns of `myotact stiffness` (q and u excepted), K_error (K less its central difference),
/// least_K (over angles up to 10 degrees away, activations held); held, 1 or 0; factor, K at the last over K at the
/// first level; by muscle arm(key), arm_slope(key) and stretch(key), the latter at the first level.
Quantities line_stiffness_table(JsonObject& inputs);

/// How co-contraction changes K from level 0 to 1 in equal steps, where the fibres of all muscles have one stretch at
/// the pose itself. Inputs: model, stretches, steps. Quantities by stretch: factor and factor_srs, K(1)/K(0) without
/// and with short-range stiffness; least_K of all levels; falls, how many of the steps lower K.
Quantities co_contraction_factors(JsonObject& inputs);

/// A joint in balance gets a pulse and is followed step by step, with force-velocity. Inputs: model, levels,
/// velocity_rad_s (just after the pulse), dt_s, end_s. Quantities by level: departure, the largest distance from the
/// linear response of I, K, B and the tendons, over that response's largest angle; swing_rad, that angle.
Quantities pulse_response(JsonObject& inputs);

}  // namespace myotact::measure
