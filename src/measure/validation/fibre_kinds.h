#pragma once

#include "measure/validation/kinds.h"

namespace myotact::measure {

/// Force curves at listed places. Inputs: curve_set; activation (1); lengths, speeds and tendon_strains, lists that may
/// be left out. Quantities: active(n), active_slope(n), passive(n), passive_slope(n), force_velocity(v),
/// force_velocity_slope(v), tendon(strain).
Quantities force_curve_values(JsonObject& inputs);

/// Speed under constant loads at the optimal length. Inputs: curve_set; activation (1); loads, over the active
/// isometric force. Quantities: shortening(load), over the largest shortening speed, positive when it shortens.
Quantities isotonic_velocity(JsonObject& inputs);

/// Activation under a constant excitation, in steps. Inputs: activation, excitation, activation_tau_s,
/// deactivation_tau_s, dt_s, times_s (whole multiples of dt_s). Quantities: activation(time).
Quantities activation(JsonObject& inputs);

}  // namespace myotact::measure
