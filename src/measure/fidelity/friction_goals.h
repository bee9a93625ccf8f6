#pragma once

#include "measure/fidelity/goal.h"

namespace myotact::measure {

/// Goal 6: the friction coefficient that the hand feels against the one asked for: mean error, spread and breakaway on
/// a plane, in every direction over fibres, on a ball, and on a faceted muscle.
GoalFigures measure_friction_coefficient(Effort effort);

/// Goal 7: how far a tool that sticks to moving tissue creeps over it in 60 s.
GoalFigures measure_sticking(Effort effort);

}  // namespace myotact::measure
