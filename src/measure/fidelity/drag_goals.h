#pragma once

#include "measure/fidelity/goal.h"

namespace myotact::measure {

// How true a thing in hand is: the paw at the end of a joint, a muscle line.

/// Goal 9: joint stiffness felt at the paw against the model's, relaxed and co-contracted, and how soon a torque is
/// felt. Scene elbow, its muscles as lines.
GoalFigures measure_joint_at_paw(Effort effort);
/// Goal 17: force of a line in hand against the closed form of a strand between two fixed ends, dragged sideways.
GoalFigures measure_line_drag(Effort effort);

}  // namespace myotact::measure
