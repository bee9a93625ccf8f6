#pragma once

#include "measure/fidelity/goal.h"

namespace myotact::measure {

/// Goal 10: the stiffest wall that stays calm, over the bound of the device's profile, in a hand and without one.
GoalFigures measure_stable_stiffness(Effort effort);

/// Goal 15: energy that the rendering gives a hand that pokes about at random, all effects on.
GoalFigures measure_energy_given(Effort effort);

}  // namespace myotact::measure
