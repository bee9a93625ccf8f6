#pragma once

#include "measure/fidelity/goal.h"

namespace myotact::measure {

/// Goal 20: force within its limit whatever goes wrong, and gone at once: faults of device, numbers, clock, models and
/// stops at random, a yank, a stall of the simulation, a program that is killed.
GoalFigures measure_safety(Effort effort);

}  // namespace myotact::measure
