#include "core/at.h"
#include "simulation/muscle/fibre_field.h"
#include "simulation/simulation_impl.h"

// What can be asked of the simulation between steps.

namespace myotact::simulation {

LineGeometry Simulation::Impl::line_geometry_of(int muscle) const {
  LineGeometry geometry;
  measure_line(*lines[at(muscle)].line, limb.skeleton, geometry);
  return geometry;
}

/// What the muscle's line does now; of a Line muscle at rest at its present length, which is what its stiffness means.
LineForce Simulation::Impl::line_force_of(int muscle, const LineGeometry& geometry) const {
  const LimbMuscle& m = limb.muscles[at(muscle)];
  if (m.line) return resting_force(*m.line, m.state.activation);
  const double speed_m_s = geometry.slope_m_rad.dot(limb.now.velocity_rad_s);
  return line_force(specimen.muscles[at(muscle)], geometry.length_m - lines[at(muscle)].length_m, speed_m_s,
                    m.state.activation);
}

std::vector<LineReading> Simulation::Impl::read_lines() const {
  std::vector<LineReading> readings;
  for (int m = 0; m < static_cast<int>(lines.size()); ++m) {
    const LineGeometry geometry = line_geometry_of(m);
    readings.push_back({geometry, line_force_of(m, geometry)});
  }
  return readings;
}

/// That the muscle hands to its tendon; of one that is only a shape, what its line would.
double Simulation::Impl::tension_N(int muscle) const {
  const LimbMuscle& m = limb.muscles[at(muscle)];
  return only_follows(m) ? line_force_of(muscle, line_geometry_of(muscle)).force_N : m.readout.tension_N;
}

/// Of one that is only a shape, what its line would have.
double Simulation::Impl::fibre_stretch(int muscle, const LineReading& line) const {
  const LimbMuscle& m = limb.muscles[at(muscle)];
  if (m.line) return m.line->fibre_now_m / m.line->hill.optimal_fibre_m;
  return m.rigid ? line.force.fibre_stretch : mean_fibre_length(m.tissue, m.state.now.stretch);
}

double Simulation::muscle_force_N(int muscle) const {
  return impl_->tension_N(muscle);
}

double Simulation::muscle_torque_Nm(int muscle, int joint) const {
  return impl_->limb.muscles[at(muscle)].readout.torque_Nm[joint];
}

/// A muscle that is only a shape has no part in any joint.
MuscleAtJoint Simulation::Impl::at_joint(int muscle, int joint, const LineReading& line) const {
  const LimbMuscle& m = limb.muscles[at(muscle)];
  if (only_follows(m)) return {};
  const LineJointTerms terms = line_joint_terms(line.geometry, line.force, joint);
  MuscleAtJoint part;
  part.torque_Nm = m.readout.torque_Nm[joint];
  part.stiffness_Nm_rad = m.stiffness_Nm_rad[joint];
  part.contact_Nm_rad = m.contact_stiffness_Nm_rad[joint];
  part.line_muscle_Nm_rad = terms.muscle_Nm_rad;
  part.line_geometry_Nm_rad = terms.geometry_Nm_rad;
  part.line_damping_Nms_rad = terms.damping_Nms_rad;
  part.moment_arm_m = -line.geometry.slope_m_rad[joint];
  part.moment_arm_slope_m_rad = -line.geometry.curvature_m_rad2(joint, joint);
  if (m.line) part.unit = hill_equilibrium(m.line->hill, m.line->length_m, m.state.activation);
  return part;
}

MuscleAtJoint Simulation::muscle_at_joint(int muscle, int joint) const {
  const LineGeometry geometry = impl_->line_geometry_of(muscle);
  return impl_->at_joint(muscle, joint, {geometry, impl_->line_force_of(muscle, geometry)});
}

JointReadout Simulation::Impl::joint(int joint, const std::vector<LineReading>& lines_now) const {
  JointReadout readout;
  readout.angle_rad = limb.now.angle_rad[joint];
  readout.velocity_rad_s = limb.now.velocity_rad_s[joint];
  readout.passive_Nm_rad = limb.loads.passive_Nm_rad[joint];
  readout.stiffness_Nm_rad = readout.passive_Nm_rad;
  readout.inertia_kg_m2 = limb.loads.mass_kg_m2(joint, joint);
  readout.own_torque_Nm = limb.loads.force_Nm[joint] - limb.external_torque_Nm[joint] +
                          limb.loads.damping_Nms_rad[joint] * readout.velocity_rad_s;
  readout.joint_damping_Nms_rad = readout.damping_Nms_rad = limb.loads.damping_Nms_rad[joint];
  for (std::size_t m = 0; m < limb.muscles.size(); ++m) {
    const MuscleAtJoint part = at_joint(static_cast<int>(m), joint, lines_now[m]);
    readout.net_torque_Nm += part.torque_Nm;
    readout.stiffness_Nm_rad += part.stiffness_Nm_rad;
    readout.contact_Nm_rad += limb.muscles[m].contact_stiffness_Nm_rad[joint];
    readout.line_muscle_Nm_rad += part.line_muscle_Nm_rad;
    readout.line_geometry_Nm_rad += part.line_geometry_Nm_rad;
    readout.damping_Nms_rad += part.line_damping_Nms_rad;
    readout.preview |=
        limb.muscles[m].tissue.model == TissueModel::MassSpring && spans_joint(*lines[m].line, limb.skeleton, joint);
  }
  return readout;
}

JointReadout Simulation::joint(int joint) const {
  return impl_->joint(joint, impl_->read_lines());
}

int Simulation::muscle_count() const {
  return static_cast<int>(impl_->limb.muscles.size());
}

Pose Simulation::Impl::body_pose(int body) const {
  return tether ? tether->body_pose(body) : limb.skeleton.body_pose(body);
}

Pose Simulation::body_pose(int body) const {
  return impl_->body_pose(body);
}

bool Simulation::particle_lost() const {
  return impl_->tether && impl_->tether->lost();
}

std::span<const Vec3> Simulation::skin_world_m(int muscle) const {
  return impl_->surfaces.current_m(muscle);
}

std::span<const double> Simulation::nodes_world_m(int muscle) const {
  const Eigen::VectorXd& position_m = impl_->limb.muscles[at(muscle)].state.now.position_m;
  return {position_m.data(), at(static_cast<int>(position_m.size()))};
}

std::span<const double> Simulation::node_velocities_world_m_s(int muscle) const {
  const Eigen::VectorXd& velocity_m_s = impl_->limb.muscles[at(muscle)].state.now.velocity_m_s;
  return {velocity_m_s.data(), at(static_cast<int>(velocity_m_s.size()))};
}

std::vector<Vec3> Simulation::line_world_m(int muscle) const {
  return line_points_W(*impl_->lines[at(muscle)].line, impl_->limb.skeleton);
}

int Simulation::stuck_line() const {
  for (int m = 0; m < static_cast<int>(impl_->lines.size()); ++m) {
    if (only_follows(impl_->limb.muscles[at(m)]) || impl_->lines[at(m)].line->wraps.empty()) continue;
    if (impl_->line_geometry_of(m).stuck_wrap >= 0) return m;
  }
  return -1;
}

double Simulation::volume_ratio(int muscle) const {
  return impl_->limb.muscles[at(muscle)].readout.volume_ratio;
}

double Simulation::contact_force_N(int muscle) const {
  return impl_->limb.muscles[at(muscle)].readout.contact_N;
}

double Simulation::contact_depth_m(int muscle) const {
  return impl_->limb.muscles[at(muscle)].readout.contact_depth_m;
}

double Simulation::residual_share() const {
  return impl_->residual_share;
}

double Simulation::smallest_volume_ratio(int muscle) const {
  return impl_->limb.muscles[at(muscle)].readout.smallest_J;
}

std::uint64_t Simulation::state_hash() const {
  std::uint64_t hash = hash_of_state(impl_->limb);
  if (impl_->tether) add_to_hash(impl_->tether->state(), hash);
  return hash;
}

}  // namespace myotact::simulation
