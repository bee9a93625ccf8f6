#pragma once

#include "measure/fidelity/goal.h"

namespace myotact::measure {

// How true and how calm a press on tissue is that a slower simulation moves; tissue as in point_tissue.h.

/// Goal 8: stiffness felt at the device against the tissue's own, at rest.
GoalFigures measure_felt_stiffness(Effort effort);
/// Goal 11: the stiffest coupling that stays calm with a simulation at 62.5, 100 and 200 Hz, one step late.
GoalFigures measure_multirate_stability(Effort effort);
/// Goal 12: force jitter above 20 Hz in a press of 1 N.
GoalFigures measure_press_jitter(Effort effort);
/// Goal 18: what the hand gets a second against what the tissue gets.
GoalFigures measure_impulse_balance(Effort effort);

}  // namespace myotact::measure
