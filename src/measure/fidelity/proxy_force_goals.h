#pragma once

#include "measure/fidelity/goal.h"

namespace myotact::measure {

/// Goal 13: the largest change of the force within one tick while the device slides at 50 mm/s over smooth shapes cut
/// into triangles, at rest and moving.
GoalFigures measure_force_steps(Effort effort);

/// Goal 14: how deep the sphere goes into the triangles, and the device's depth against force over stiffness.
GoalFigures measure_penetration(Effort effort);

}  // namespace myotact::measure
