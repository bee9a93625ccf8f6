#pragma once

#include "measure/fidelity/goal.h"

namespace myotact::measure {

/// Goal 22: two hands on one moving mesh, each with its own device and loop. Where they do not meet, each feels to the
/// bit what it feels alone; one emergency stop; what a tick costs beside another (timing).
GoalFigures measure_two_hands(Effort effort);

}  // namespace myotact::measure
