#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measure/joint_response.h"
#include "measure/line/wrapped_path.h"
#include "simulation/line/hill_muscle.h"
#include "simulation/line/line_model.h"

namespace myotact::measure {

enum class Side { Flexor, Extensor };

/// A one-dimensional muscle over a hinge.
struct LineMuscle {
  std::string key;
  Side side = Side::Flexor;
  bool driven = true;  // else passive: its activation is 0
  WrappedPath path;
  simulation::HillMuscle unit;
};

/// One hinge and the muscles over it; nothing else acts, all other joints are fixed.
struct LineJoint {
  std::string name;
  double inertia_kg_m2 = 0.0;         // of what rotates, about the hinge
  std::optional<double> paw_lever_m;  // from the axis to where a hand pushes
  std::vector<LineMuscle> muscles;
};

/// Activation of the driven muscles of each side, 0 .. 1.
struct SideLevels {
  double flexors = 0.0, extensors = 0.0;
};

struct LineMuscleState {
  double activation = 0.0;
  PathGeometry path;
  simulation::HillForce force;
};

/// Equilibrium of all muscles with the joint held at one angle.
struct LineJointState {
  simulation::LineJointTerms flexors, extensors;  // torque, K and B of each side; positive flexes
  std::vector<LineMuscleState> muscles;           // as in the joint

  /// tau, K = sum r^2 k - (dr/dq) F and B = sum r^2 b, b that of the fibres.
  simulation::LineJointTerms all() const;
};

LineJointState line_joint_state(const LineJoint& joint, double q_rad, const SideLevels& levels,
                                simulation::FibreStiffness kind = simulation::FibreStiffness::ForceLength);

/// Who balances whom at one level of co-contraction.
struct LineBalance {
  SideLevels levels;
  bool held = true;  // false: the passive pull of one side beats the other at full activation
};

/// Levels at which all torques cancel, passive ones included. The side that is weaker at full activation takes `level`
/// and the other what balances it; where that one's passive pull is already too much it gets 0, and the weaker side
/// what balances it. Each side needs a driven muscle.
LineBalance balance_sides(const LineJoint& joint, double q_rad, double level);

/// The joint made linear about a state, activations held; the fibres' damping is that of force-velocity at rest.
JointResponse response_of(const LineJoint& joint, const LineJointState& state);

}  // namespace myotact::measure
