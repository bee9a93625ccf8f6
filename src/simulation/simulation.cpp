#include "simulation/simulation.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "simulation/activation.h"
#include "simulation/calibration.h"
#include "simulation/line_model.h"
#include "simulation/local_grip.h"
#include "simulation/settle.h"
#include "simulation/step.h"
#include "simulation/surfaces.h"
#include "simulation/tool_springs.h"

namespace myotact::simulation {
namespace {

/// A step that fails is cut in halves this often before it is given up.
constexpr int kMostHalvings = 3;
/// Every so many steps the stiffness of one muscle is refreshed: seven muscles in 0.21 s, as fast as a plot is read.
constexpr int kStepsPerRefresh = 3;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}
double unit_range(double value) {
  return value >= 0.0 ? std::min(value, 1.0) : 0.0;
}  // NaN becomes 0

/// A muscle line with what does not change.
struct LineRest {
  const anatomy::MuscleLine* line = nullptr;
  std::vector<double> fractions;
  double length_m = 0.0;
};

}  // namespace

struct Simulation::Impl {
  Impl(const anatomy::Specimen& given, const SimulationSettings& chosen)
      : specimen(given),
        settings(chosen),
        limb(specimen, settings.tissue, settings.tendon, settings.contact),
        workers(chosen.workers),
        surfaces(specimen, limb) {
    limb.gravity_m_s2 = settings.gravity_m_s2;
    excitations.assign(specimen.muscles.size(), 0.0);
    workers.run(static_cast<int>(specimen.muscles.size()), [&](int m) {
      if (!limb.muscles[at(m)].rigid) calibrate_muscle(specimen, m, limb.skeleton, limb.muscles[at(m)]);
    });
    for (int m = 0; m < static_cast<int>(specimen.muscles.size()); ++m) {
      const auto found = std::find_if(specimen.lines.begin(), specimen.lines.end(),
                                      [m](const anatomy::MuscleLine& l) { return l.muscle == m; });
      LineGeometry geometry;
      measure_line(*found, limb.skeleton, geometry);
      lines.push_back({&*found, arc_fractions(line_points_W(*found, limb.skeleton)), geometry.length_m});
    }
    workers.run(surfaces.count(), [&](int surface) { surfaces.follow(limb, surface, true); });
    read_out(limb);
  }

  anatomy::Specimen specimen;
  SimulationSettings settings;
  Limb limb;
  WorkerPool workers;
  Surfaces surfaces;
  std::vector<double> excitations;
  std::vector<LineRest> lines;  // one a muscle
  std::uint64_t steps = 0;
  int whole_steps = 0;   // of equal length since the last restart; the second-order rule needs one
  int next_refresh = 0;  // muscle whose stiffness is refreshed by the next step
  int failed_steps = 0;
  double residual_share = 0.0;  // of the last step

  double time_s() const { return static_cast<double>(steps) * settings.dt_s; }
  bool advance_in_parts(double dt_s, int halvings);
  LineForce line_force_of(int muscle) const;
  LineGeometry line_geometry_of(int muscle) const;
  double tension_N(int muscle) const;
  void write_contact(const messages::ToolContact& contact, messages::LocalModel& model) const;
  void write_line(const messages::ToolState& tool, messages::LocalModel& model) const;
  void write_grip(const messages::ToolState& tool, messages::LocalModel& model) const;
};

/// Two backward-Euler steps of half the length, or more parts where those fail too.
bool Simulation::Impl::advance_in_parts(double dt_s, int halvings) {
  for (int half = 0; half < 2; ++half) {
    push_history(limb);
    const StepReport report = advance(limb, {0.5 * dt_s, false}, workers);
    residual_share = report.residual_share;
    if (report.sound) continue;
    restore_last(limb);
    if (halvings >= kMostHalvings || !advance_in_parts(0.5 * dt_s, halvings + 1)) return false;
  }
  return true;
}

LineGeometry Simulation::Impl::line_geometry_of(int muscle) const {
  LineGeometry geometry;
  measure_line(*lines[at(muscle)].line, limb.skeleton, geometry);
  return geometry;
}

/// What the muscle's line does now; of a Line muscle at rest at its present length, which is what its stiffness means.
LineForce Simulation::Impl::line_force_of(int muscle) const {
  if (const std::optional<LineTissue>& line = limb.muscles[at(muscle)].line) {
    return resting_force(*line, limb.muscles[at(muscle)].state.activation);
  }
  const LineGeometry geometry = line_geometry_of(muscle);
  const double speed_m_s = geometry.slope_m_rad.dot(limb.now.velocity_rad_s);
  return line_force(specimen.muscles[at(muscle)], geometry.length_m - lines[at(muscle)].length_m, speed_m_s,
                    limb.muscles[at(muscle)].state.activation);
}

/// That the muscle hands to its tendon; of one that is only a shape, what its line would.
double Simulation::Impl::tension_N(int muscle) const {
  const LimbMuscle& m = limb.muscles[at(muscle)];
  return m.rigid && !m.line ? line_force_of(muscle).force_N : m.readout.tension_N;
}

void Simulation::Impl::write_contact(const messages::ToolContact& contact, messages::LocalModel& model) const {
  model.compliance_m_N = {};
  for (std::size_t s = 0; s < limb.springs.size(); ++s) {
    const ToolSpring& spring = limb.springs[s];
    if (contact.stiffness_N_m <= 0.0 || spring.muscle < 0 || spring.muscle != contact.surface) continue;
    if (spring.target_W_m != to_vec3(contact.target_world_m)) continue;
    const Mat3& compliance = limb.spring_compliance_m_N[s];
    for (int k = 0; k < 9; ++k) model.compliance_m_N[at(k)] = compliance(k / 3, k % 3);
  }
}

void Simulation::Impl::write_line(const messages::ToolState& tool, messages::LocalModel& model) const {
  std::vector<std::vector<Vec3>> points;
  std::vector<LineView> views;
  for (std::size_t m = 0; m < lines.size(); ++m) points.push_back(line_points_W(*lines[m].line, limb.skeleton));
  for (std::size_t m = 0; m < lines.size(); ++m) {
    const LineForce force = line_force_of(static_cast<int>(m));
    views.push_back({static_cast<int>(m), points[m], lines[m].fractions, std::max(0.0, tension_N(static_cast<int>(m))),
                     force.stiffness_N_m, force.damping_Ns_m});
  }
  model.line = local_line(views, {to_vec3(tool.tool_position_world_m), tool.grabbed_line, tool.grab_fraction});
}

void Simulation::Impl::write_grip(const messages::ToolState& tool, messages::LocalModel& model) const {
  model.grip = local_grip(limb, specimen, surfaces.patch(), tool);
  if (model.grip.body < 0) return;
  const int joints = limb.skeleton.joint_count();
  Eigen::MatrixXd damping_Nms_rad = Eigen::MatrixXd::Zero(joints, joints);
  for (int m = 0; m < static_cast<int>(limb.muscles.size()); ++m) {
    if (limb.muscles[at(m)].rigid && !limb.muscles[at(m)].line) continue;
    const Eigen::VectorXd slope_m_rad = line_geometry_of(m).slope_m_rad;
    damping_Nms_rad += line_force_of(m).damping_Ns_m * slope_m_rad * slope_m_rad.transpose();
  }
  write_grip_motion(limb, damping_Nms_rad, settings.dt_s, model.grip);
}

Simulation::Simulation(const anatomy::Specimen& specimen, const SimulationSettings& settings) {
  const std::string defect = anatomy::find_defect(specimen);
  if (!defect.empty()) throw bad_data("specimen", specimen.name, defect);
  if (!(settings.dt_s > 0.0 && settings.dt_s <= 0.1)) {
    throw bad_data("scene", "/dt_s", "is " + to_text(settings.dt_s) + " s; must be in (0, 0.1]");
  }
  if (!settings.tissue.empty() && settings.tissue.size() != specimen.muscles.size()) {
    throw bad_data("scene", "/tissue",
                   "names " + std::to_string(settings.tissue.size()) + " models for " +
                       std::to_string(specimen.muscles.size()) + " muscles; must be one a muscle");
  }
  impl_ = std::make_unique<Impl>(specimen, settings);
}

Simulation::~Simulation() = default;

void Simulation::set_excitation(int muscle, double excitation) {
  impl_->excitations[at(muscle)] = unit_range(excitation);
}

void Simulation::set_joint_locked(int joint, bool locked) {
  if (impl_->limb.skeleton.locked(joint) == locked) return;
  impl_->limb.skeleton.set_locked(joint, locked);
  impl_->limb.now.velocity_rad_s[joint] = 0.0;
  impl_->whole_steps = 0;
}

void Simulation::set_gravity(const Vec3& gravity_m_s2) {
  impl_->limb.gravity_m_s2 = gravity_m_s2;
}

void Simulation::set_joint_torque(int joint, double torque_Nm) {
  impl_->limb.external_torque_Nm[joint] = std::isfinite(torque_Nm) ? torque_Nm : 0.0;
}

void Simulation::restart() {
  return_to_file_pose(impl_->limb);
}

bool Simulation::settle(std::span<const double> joint_angles_rad, std::span<const double> activations) {
  Impl& in = *impl_;
  const bool usable =
      joint_angles_rad.size() == static_cast<std::size_t>(in.limb.skeleton.joint_count()) &&
      std::all_of(joint_angles_rad.begin(), joint_angles_rad.end(), [](double q) { return std::isfinite(q); });
  if (!usable) return false;
  for (std::size_t m = 0; m < in.limb.muscles.size(); ++m) {
    in.excitations[m] = in.limb.muscles[m].state.activation = m < activations.size() ? unit_range(activations[m]) : 0.0;
  }
  const bool settled = settle_limb(in.limb, joint_angles_rad, in.workers);
  in.workers.run(static_cast<int>(in.limb.muscles.size()),
                 [&](int m) { refresh_contact_stiffness(in.limb, in.limb.muscles[at(m)]); });
  in.workers.run(in.surfaces.count(), [&](int surface) { in.surfaces.follow(in.limb, surface, true); });
  in.whole_steps = 0;
  return settled;
}

void Simulation::step(std::span<const messages::ToolState> tools) {
  Impl& in = *impl_;
  const double dt_s = in.settings.dt_s;
  for (std::size_t m = 0; m < in.limb.muscles.size(); ++m) {
    const anatomy::Muscle& muscle = in.specimen.muscles[m];
    double& activation = in.limb.muscles[m].state.activation;
    activation =
        step_activation(activation, in.excitations[m], {muscle.activation_tau_s, muscle.deactivation_tau_s}, dt_s);
  }
  in.limb.springs = tool_springs(tools, {in.specimen, in.surfaces.skins()}, in.limb);
  push_history(in.limb);
  const StepReport report = advance(in.limb, {dt_s, in.whole_steps > 0}, in.workers);
  in.residual_share = report.residual_share;
  bool sound = report.sound;
  ++in.whole_steps;
  if (!sound) {
    in.whole_steps = 0;
    ++in.failed_steps;
    restore_last(in.limb);
    sound = in.advance_in_parts(dt_s, 1);
    if (!sound) stop_moving(in.limb);  // in the last usable pose
  }
  // One muscle's stiffness beside the surfaces: it reads the positions that they read.
  const bool refreshes = !in.limb.muscles.empty() && in.steps % kStepsPerRefresh == 0;
  in.workers.run(in.surfaces.count() + 1, [&](int task) {
    if (task > 0) in.surfaces.follow(in.limb, task - 1, false);
    if (task == 0 && refreshes) refresh_muscle_stiffness(in.limb, in.limb.muscles[at(in.next_refresh)]);
  });
  if (refreshes) in.next_refresh = (in.next_refresh + 1) % static_cast<int>(in.limb.muscles.size());
  ++in.steps;
}

double Simulation::time_s() const {
  return impl_->time_s();
}
double Simulation::activation(int muscle) const {
  return impl_->limb.muscles[at(muscle)].state.activation;
}
double Simulation::excitation(int muscle) const {
  return impl_->excitations[at(muscle)];
}
int Simulation::failed_steps() const {
  return impl_->failed_steps;
}

double Simulation::muscle_force_N(int muscle) const {
  return impl_->tension_N(muscle);
}

double Simulation::muscle_torque_Nm(int muscle, int joint) const {
  return impl_->limb.muscles[at(muscle)].readout.torque_Nm[joint];
}

MuscleAtJoint Simulation::muscle_at_joint(int muscle, int joint) const {
  const LineJointTerms line = line_joint_terms(impl_->line_geometry_of(muscle), impl_->line_force_of(muscle), joint);
  const LimbMuscle& m = impl_->limb.muscles[at(muscle)];
  return {m.readout.torque_Nm[joint], m.stiffness_Nm_rad[joint], line.muscle_Nm_rad, line.geometry_Nm_rad};
}

JointReadout Simulation::joint(int joint) const {
  const Limb& limb = impl_->limb;
  JointReadout readout;
  readout.angle_rad = limb.now.angle_rad[joint];
  readout.velocity_rad_s = limb.now.velocity_rad_s[joint];
  readout.passive_Nm_rad = limb.loads.passive_Nm_rad[joint];
  readout.stiffness_Nm_rad = readout.passive_Nm_rad;
  readout.inertia_kg_m2 = limb.loads.mass_kg_m2(joint, joint);
  readout.damping_Nms_rad = limb.loads.damping_Nms_rad[joint];
  for (std::size_t m = 0; m < limb.muscles.size(); ++m) {
    const int muscle = static_cast<int>(m);
    readout.net_torque_Nm += limb.muscles[m].readout.torque_Nm[joint];
    readout.stiffness_Nm_rad += limb.muscles[m].stiffness_Nm_rad[joint];
    readout.contact_Nm_rad += limb.muscles[m].contact_stiffness_Nm_rad[joint];
    if (limb.muscles[m].rigid && !limb.muscles[m].line) continue;  // its line exerts nothing
    const LineJointTerms terms = line_joint_terms(impl_->line_geometry_of(muscle), impl_->line_force_of(muscle), joint);
    readout.line_muscle_Nm_rad += terms.muscle_Nm_rad;
    readout.line_geometry_Nm_rad += terms.geometry_Nm_rad;
    readout.damping_Nms_rad += terms.damping_Nms_rad;
    readout.preview |= limb.muscles[m].tissue.model == TissueModel::MassSpring &&
                       spans_joint(*impl_->lines[m].line, limb.skeleton, joint);
  }
  return readout;
}

Pose Simulation::body_pose(int body) const {
  return impl_->limb.skeleton.body_pose(body);
}
std::span<const Vec3> Simulation::skin_world_m(int muscle) const {
  return impl_->surfaces.current_m(muscle);
}

std::vector<Vec3> Simulation::line_world_m(int muscle) const {
  return line_points_W(*impl_->lines[at(muscle)].line, impl_->limb.skeleton);
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
  return hash_of_state(impl_->limb);
}

void Simulation::write_local_model(const messages::ToolState& tool, messages::LocalModel& model) const {
  const Impl& in = *impl_;
  model.sequence = in.steps;
  model.published_at_ns = static_cast<std::uint64_t>(std::llround(in.time_s() * 1e9));
  model.dt_ns = static_cast<std::uint64_t>(std::llround(in.settings.dt_s * 1e9));
  model.tool_sequence = tool.sequence;
  in.surfaces.patch().write(to_vec3(tool.proxy_position_world_m), model);
  in.write_contact(tool.contact, model);
  in.write_line(tool, model);
  in.write_grip(tool, model);
  model.joint = {};
  for (int j = 0; j < in.limb.skeleton.joint_count(); ++j) {
    if (!in.limb.skeleton.moves(j)) continue;
    const JointReadout readout = joint(j);
    model.joint = {readout.angle_rad,        readout.velocity_rad_s,
                   readout.inertia_kg_m2,    in.limb.loads.damping_Nms_rad[j],
                   readout.stiffness_Nm_rad, readout.net_torque_Nm};
    break;
  }
}

void Simulation::write_frame(messages::SceneFrame& frame) const {
  const Impl& in = *impl_;
  frame.sequence = in.steps;
  frame.time_s = in.time_s();
  frame.residual_share = in.residual_share;
  const std::size_t muscles = in.limb.muscles.size();
  frame.body_poses.resize(in.specimen.bodies.size());
  for (std::size_t b = 0; b < frame.body_poses.size(); ++b) {
    const Pose& pose = in.limb.skeleton.body_pose(static_cast<int>(b));
    for (int k = 0; k < 12; ++k) {
      const int row = k / 4, column = k % 4;
      frame.body_poses[b][at(k)] = column < 3 ? pose.rotation(row, column) : pose.translation_m[row];
    }
  }
  frame.skins_world_m.resize(muscles);
  frame.lines_world_m.resize(muscles);
  frame.activations.resize(muscles);
  frame.tensions_N.resize(muscles);
  frame.volume_ratios.resize(muscles);
  frame.smallest_volume_ratios.resize(muscles);
  for (std::size_t m = 0; m < muscles; ++m) {
    const int muscle = static_cast<int>(m);
    frame.activations[m] = activation(muscle);
    frame.tensions_N[m] = muscle_force_N(muscle);
    frame.volume_ratios[m] = volume_ratio(muscle);
    frame.smallest_volume_ratios[m] = smallest_volume_ratio(muscle);
    const std::span<const Vec3> skin = skin_world_m(muscle);
    frame.skins_world_m[m].resize(skin.size());
    std::transform(skin.begin(), skin.end(), frame.skins_world_m[m].begin(), [](const Vec3& p) {
      return std::array<float, 3>{static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
    });
    const std::vector<Vec3> line = line_world_m(muscle);
    frame.lines_world_m[m].resize(line.size());
    std::transform(line.begin(), line.end(), frame.lines_world_m[m].begin(), to_array);
  }
  frame.joints.resize(in.specimen.joints.size());
  for (std::size_t j = 0; j < frame.joints.size(); ++j) {
    const JointReadout readout = joint(static_cast<int>(j));
    frame.joints[j] = {readout.angle_rad, readout.net_torque_Nm, readout.stiffness_Nm_rad, readout.preview};
  }
}

}  // namespace myotact::simulation
