#pragma once

#include <vector>

#include <Eigen/Core>

#include "measure/line/line_joint.h"

namespace myotact::measure {

/// How a joint is set going and for how long.
struct LineMotion {
  double angle_rad = 0.0;  // the fibres start in equilibrium there
  double velocity_rad_s = 0.0;
  SideLevels levels;           // held throughout
  bool force_velocity = true;  // false: the fibres follow their static force-length curves
  double dt_s = 0.0;
  int steps = 0;
};

/// The joint's angle after each step, muscles and joint implicit by second-order backward differences (the first step
/// by backward Euler), to convergence.
std::vector<double> move_line_joint(const LineJoint& joint, const LineMotion& motion);

/// The same of the joint made linear about `state`, exact in time: the angle beyond that of the state.
std::vector<double> move_linear_joint(const LineJoint& joint, const LineJointState& state, const LineMotion& motion);

}  // namespace myotact::measure
