#pragma once

#include "measure/fidelity/goal.h"

namespace myotact::measure {

/// Goal 19: the hand on one side of a slow link and the simulation on the other, on a virtual clock, beside the same
/// hand without a link: error and size of the force, net energy, what comes at once after a stall. On the scene `elbow`
/// for all of a touch, and on `spring` and `particle` for long.
GoalFigures measure_network(Effort effort);

}  // namespace myotact::measure
