#include "measure/line/line_joint.h"

namespace myotact::measure {
namespace {

simulation::LineJointTerms terms_of(const LineMuscleState& muscle) {
  const auto& [activation, path, force] = muscle;
  const double r_m = path.arm_m;
  return {r_m * force.force_N, r_m * r_m * force.stiffness_N_m, -path.arm_slope_m_rad * force.force_N,
          r_m * r_m * force.fibre_damping_Ns_m};
}

}  // namespace

simulation::LineJointTerms LineJointState::all() const {
  simulation::LineJointTerms sum = flexors;
  sum += extensors;
  return sum;
}

LineJointState line_joint_state(const LineJoint& joint, double q_rad, const SideLevels& levels,
                                simulation::FibreStiffness kind) {
  LineJointState state;
  for (const LineMuscle& muscle : joint.muscles) {
    const bool flexes = muscle.side == Side::Flexor;
    LineMuscleState now;
    now.activation = !muscle.driven ? 0.0 : flexes ? levels.flexors : levels.extensors;
    now.path = measure_path(muscle.path, q_rad);
    now.force = simulation::hill_equilibrium(muscle.unit, now.path.length_m, now.activation, kind);
    (flexes ? state.flexors : state.extensors) += terms_of(now);
    state.muscles.push_back(now);
  }
  return state;
}

JointResponse response_of(const LineJoint& joint, const LineJointState& state) {
  JointResponse response;
  response.inertia_kg_m2 = joint.inertia_kg_m2;
  for (const LineMuscleState& muscle : state.muscles) {
    add_muscle(muscle.path.arm_m, muscle.path.arm_slope_m_rad, muscle.force, response);
  }
  return response;
}

}  // namespace myotact::measure
