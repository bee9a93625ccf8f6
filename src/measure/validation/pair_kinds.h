#pragma once

#include "measure/validation/kinds.h"

namespace myotact::measure {

// Kinds of two like one-dimensional muscles on the two sides of a hinge. *Pair* stands for: peak_force_N,
// optimal_fibre_m, tendon (rigid or elastic), tendon_slack_m, inertia_kg_m2 (0.005), and their path: either arm_m, a
// moment arm that stays the same, or origin_m and insertion_m ([x, z] from the hinge, x across and z along the limb),
// between which the muscle runs straight.

/// Inputs: pair, length_m (of the whole unit at the start), activations. Quantities by activation: stretch (fibre
/// length over the optimal one), force_N, damping_Ns_m (of one muscle's fibres), K, r2k, geo, B, K_error (K less the
/// central difference of the torque), frequency_hz (sqrt(K/I)/2pi); arm_slope_m_rad, the same at every activation.
Quantities antagonist_pair(JsonObject& inputs);

/// Short-range stiffness of a pair whose fibres are at their optimal length, however much the tendon gives. Inputs:
/// pair, activations. Quantities: K_srs(activation).
Quantities short_range_pair(JsonObject& inputs);

/// A pair swings freely, its fibres without force-velocity, and is followed step by step. Inputs: pair, length_m,
/// activations, amplitude_rad, dt_s. Quantities by activation: frequency_hz, over ten passages through the middle, NaN
/// when there are none; amplitude_kept, of the first swing over the ninth.
Quantities pair_oscillation(JsonObject& inputs);

}  // namespace myotact::measure
