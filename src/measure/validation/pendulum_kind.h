#pragma once

#include "measure/validation/kinds.h"

namespace myotact::measure {

/// A uniform rod that swings from rest about a hinge at its end: a specimen of two bodies and a joint without muscles,
/// advanced by the simulation itself. Inputs: length_m, mass_kg, gravity_m_s2, amplitude_rad, dt_s. Quantities:
/// period_s, the time between every second passage through the lowest point; energy_gain, the largest energy after the
/// start over that at the start, less 1; failed_steps.
Quantities hinge_pendulum(JsonObject& inputs);

}  // namespace myotact::measure
