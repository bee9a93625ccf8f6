#pragma once

#include "measure/fidelity/goal.h"

namespace myotact::measure {

/// Goal 21: the scene `elbow` is touched and dragged by its script, recorded, and felt again from the file. Short: with
/// lines, 6 s of it; full: finite elements, the whole script.
GoalFigures measure_replay(Effort effort);

}  // namespace myotact::measure
