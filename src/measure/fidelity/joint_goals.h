#pragma once

#include "measure/fidelity/goal.h"

namespace myotact::measure {

/// Goal 9: a bone of the moved limb is taken in hand and rotated, at elbow, stifle and hock: the stiffness that is felt
/// against the joint's own.
GoalFigures measure_joint_at_paw(Effort effort);

}  // namespace myotact::measure
