#pragma once

#include "measure/fidelity/goal.h"

namespace myotact::measure {

/// Goal 16: the spectrum of the vibration that a slide gives, against the auto-regressive model of the texture's file,
/// at five forces and five speeds.
GoalFigures measure_texture_spectrum(Effort effort);

}  // namespace myotact::measure
