#pragma once

#include "measure/fidelity/goal.h"

namespace myotact::measure {

/// Goal 5: the haptic thread on the wall clock with a simulated device and a model every 10 ms. All timing.
GoalFigures measure_loop_period(Effort effort);

}  // namespace myotact::measure
