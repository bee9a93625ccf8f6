#pragma once

#include "measure/fidelity/goal.h"

namespace myotact::measure {

/// Goal 17: force of a line in hand against the closed form of a strand between two fixed ends, dragged sideways.
GoalFigures measure_line_drag(Effort effort);

}  // namespace myotact::measure
