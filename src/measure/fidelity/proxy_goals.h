#pragma once

#include "measure/fidelity/goal.h"

namespace myotact::measure {

/// Goal 1: random approaches to a swelling, rippling ball, and a test frame by frame, in which CHAI3D always fell
/// through: contact 2 mm deep, then the surface moves outwards once, within one tick. Counts proxies inside (winding
/// number) and rescues.
GoalFigures measure_deforming_contact(Effort effort);

/// Goal 2: thin sheets, grooves, slides over edges and corners. Counts proxies inside, checked in closed form.
GoalFigures measure_hard_shapes(Effort effort);

}  // namespace myotact::measure
