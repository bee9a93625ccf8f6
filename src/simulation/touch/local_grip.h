#pragma once

#include "messages/local_model.h"
#include "messages/tool_state.h"
#include "simulation/limb/limb.h"
#include "simulation/touch/local_patch.h"

namespace myotact::simulation {

/// A bone farther than this from the tool is not offered to the hand; as far as a muscle line is.
inline constexpr double kBoneReach_m = kLineReach_m;

/// A tool and its place among those of the last step.
struct GripHand {
  /// Its newest state.
  const messages::ToolState& tool;
  int index = 0;
};

/// The point in hand, with the force of the hand's spring on it in the last step; else the nearest point of a bone
/// within reach; else body -1. Its motion is left zero. World frame, the rest point in L. Bones are found in `patch` as
/// of its last update.
messages::LocalGrip local_grip(const Limb& limb, const anatomy::Specimen& specimen, const LocalPatch& patch,
                               const GripHand& hand);

/// What write_grip_motion() must know beside the limb.
struct GripStep {
  const Eigen::MatrixXd& damping_Nms_rad;  // joints x joints, of the muscles alone; the joints' own is in the limb
  int tool = 0;                            // whose grip it is, in the order of the step's tools
  double dt_s = 0.0;                       // of the last step
};

/// What a hand at a point of a body feels until the next step, with the limb's joints held together in a few 3x3
/// matrices. M, D, K: mass, damping and stiffness of the joints that may rotate; J = dx/dq of the point.
///
///   M q'' = torques + J^T f     mobility W = J M^-1 J^T
///   x'' = J q''  (the point's own rotation about the axis, v^2 / r, is left to the next step)
///   dq = M^-1 J^T W^+ dx        the rotation that belongs to a displacement of the point; exact under one joint
///   stiffness J M^-1 K M^-1 J^T W^+, damping likewise with D
///
/// The springs by which other tools hold or press on bones are part of K. Sets everything but what local_grip() has
/// set. `grip.body` must be a body of the limb. Allocates.
void write_grip_motion(const Limb& limb, const GripStep& step, messages::LocalGrip& grip);

}  // namespace myotact::simulation
