#pragma once

#include "measure/validation/kinds.h"

namespace myotact::measure {

/// An undamped linear oscillator by a time rule, which damps and slows it. Inputs: rule (backward_euler, second_order
/// or trapezoid), frequency_hz, dt_s. Quantities: amplitude_kept_per_period, of the exact period; frequency_ratio, of
/// the numerical frequency to the exact one.
Quantities oscillator(JsonObject& inputs);

/// The order at which the error at end_s falls as the step is halved. Inputs: rule, frequency_hz, dt_s (the longest
/// step), end_s, halvings. Quantities: order, error (with the shortest step, over the amplitude).
Quantities oscillator_order(JsonObject& inputs);

}  // namespace myotact::measure
