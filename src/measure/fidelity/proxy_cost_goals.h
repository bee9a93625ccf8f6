#pragma once

#include "measure/fidelity/goal.h"

namespace myotact::measure {

/// Goal 3: wall time of a tick in contact with friction: the device goes round a muscle at 100 mm/s, 2 mm deep, as
/// CHAI3D was measured (tests/bench/results/2026-11-22-touch.md). All timing.
GoalFigures measure_tick_cost(Effort effort);

/// Goal 4: wall time of following a deformed surface on the simulation's side, and what the haptic thread pays to take
/// over its part. All timing.
GoalFigures measure_surface_update(Effort effort);

}  // namespace myotact::measure
