#include <algorithm>
#include <cmath>
#include <utility>

#include "core/at.h"
#include "simulation/simulation_impl.h"
#include "simulation/touch/local_grip.h"

// What the simulation publishes: the local model of the haptics, the frame of the view.

namespace myotact::simulation {
namespace {

/// With nothing to touch or to grab.
void write_tether_alone(const messages::LocalTether& tether, messages::LocalModel& model) {
  model.coverage_radius_m = 0.0;
  model.vertex_count = model.triangle_count = 0;
  model.contact = {};
  model.line = {};
  model.grip = {};
  model.joint = {};
  model.tether = tether;
}

}  // namespace

void Simulation::Impl::write_contact(const messages::ToolContact& contact, int index,
                                     messages::LocalModel& model) const {
  model.contact = {};
  const auto first = std::find_if(limb.springs.begin(), limb.springs.end(), [&](const ToolSpring& spring) {
    const bool touches = contact.stiffness_N_m > 0.0 && spring.surface == contact.surface &&
                         spring.target_W_m == to_vec3(contact.target_world_m);
    return spring.tool == index && spring.surface >= 0 && (spring.ahead || touches);
  });
  if (first == limb.springs.end()) return;
  model.contact.surface = first->surface;
  Vec3 force_N = Vec3::Zero();
  Mat3 compliance = Mat3::Zero();
  bool rests = false;  // on a surface that was found before
  for (std::size_t s = 0; s < limb.springs.size(); ++s) {
    if (limb.springs[s].open || !of_one_sphere(*first, limb.springs[s])) continue;
    if (!std::exchange(rests, true)) model.contact.surface = limb.springs[s].surface;
    if (!first->ahead) force_N += limb.spring_force_N[s];
    compliance = limb.spring_compliance_m_N[s];  // of the sphere: the same for all its points
  }
  model.contact.force_world_N = to_array(force_N);
  for (int k = 0; k < 9; ++k) model.contact.compliance_m_N[at(k)] = compliance(k / 3, k % 3);
}

messages::LocalLine Simulation::Impl::line_at(const messages::ToolState& tool, int index) const {
  std::vector<std::vector<Vec3>> points;
  std::vector<LineView> views;
  const std::vector<LineReading> lines_now = read_lines();
  for (std::size_t m = 0; m < lines.size(); ++m) points.push_back(line_points_W(*lines[m].line, limb.skeleton));
  for (std::size_t m = 0; m < lines.size(); ++m) {
    if (only_follows(limb.muscles[m])) continue;  // pulls at nothing, and would hide those that do
    const LineForce force = lines_now[m].force;
    views.push_back({static_cast<int>(m), points[m], lines[m].fractions, std::max(0.0, tension_N(static_cast<int>(m))),
                     force.stiffness_N_m, force.damping_Ns_m});
  }
  const int offered = index >= 0 && at(index) < offered_lines.size() ? offered_lines[at(index)] : -1;
  return local_line(views, {to_vec3(tool.tool_position_world_m), tool.grabbed_line, tool.grab_fraction, offered});
}

void Simulation::Impl::write_grip(const messages::ToolState& tool, int index, messages::LocalModel& model) const {
  model.grip = local_grip(limb, specimen, surfaces.patch(), {tool, index});
  if (model.grip.body < 0) return;
  const int joints = limb.skeleton.joint_count();
  Eigen::MatrixXd damping_Nms_rad = Eigen::MatrixXd::Zero(joints, joints);
  for (int m = 0; m < static_cast<int>(limb.muscles.size()); ++m) {
    if (only_follows(limb.muscles[at(m)])) continue;
    const LineGeometry geometry = line_geometry_of(m);
    damping_Nms_rad +=
        line_force_of(m, geometry).damping_Ns_m * geometry.slope_m_rad * geometry.slope_m_rad.transpose();
  }
  write_grip_motion(limb, {damping_Nms_rad, index, settings.dt_s}, model.grip);
}

void Simulation::Impl::write_joint(int index, const std::vector<LineReading>& lines_now,
                                   messages::JointFrame& frame) const {
  const JointReadout readout = joint(index, lines_now);
  frame.angle_rad = readout.angle_rad;
  frame.torque_Nm = readout.net_torque_Nm;
  frame.stiffness_Nm_rad = readout.stiffness_Nm_rad;
  frame.preview = readout.preview;
  frame.passive_Nm_rad = readout.passive_Nm_rad;
  frame.contact_Nm_rad = readout.contact_Nm_rad;
  frame.muscles.resize(lines_now.size());
  for (std::size_t m = 0; m < frame.muscles.size(); ++m) {
    const MuscleAtJoint part = at_joint(static_cast<int>(m), index, lines_now[m]);
    frame.muscles[m] = {part.torque_Nm, part.stiffness_Nm_rad, part.line_muscle_Nm_rad, part.line_geometry_Nm_rad,
                        part.moment_arm_m};
  }
}

void Simulation::write_local_model(const messages::ToolState& tool, messages::LocalModel& model, int index) const {
  const Impl& in = *impl_;
  model.sequence = in.steps;
  model.published_at_ns = static_cast<std::uint64_t>(std::llround(in.time_s() * 1e9));
  model.dt_ns = static_cast<std::uint64_t>(std::llround(in.settings.dt_s * 1e9));
  model.tool_sequence = tool.sequence;
  if (in.tether) return write_tether_alone(in.tether->local(), model);
  model.tether = {};
  in.surfaces.patch().write(to_vec3(tool.proxy_position_world_m), model);
  in.write_contact(tool.contact, index, model);
  model.line = in.line_at(tool, index);
  in.write_grip(tool, index, model);
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
    const Pose pose = in.body_pose(static_cast<int>(b));
    for (int k = 0; k < 12; ++k) {
      const int row = k / 4, column = k % 4;
      frame.body_poses[b][at(k)] = column < 3 ? pose.rotation(row, column) : pose.translation_m[row];
    }
  }
  frame.skins_world_m.resize(muscles);
  frame.lines_world_m.resize(muscles);
  frame.activations.resize(muscles);
  frame.tensions_N.resize(muscles);
  frame.stretches.resize(muscles);
  frame.volume_ratios.resize(muscles);
  frame.smallest_volume_ratios.resize(muscles);
  const std::vector<LineReading> lines = in.read_lines();
  for (std::size_t m = 0; m < muscles; ++m) {
    const int muscle = static_cast<int>(m);
    frame.activations[m] = activation(muscle);
    frame.tensions_N[m] = muscle_force_N(muscle);
    frame.stretches[m] = in.fibre_stretch(muscle, lines[m]);
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
  if (in.tether) frame.springs_world_m = in.tether->springs_world_m();
  frame.joints.resize(in.specimen.joints.size());
  for (std::size_t j = 0; j < frame.joints.size(); ++j) in.write_joint(static_cast<int>(j), lines, frame.joints[j]);
}

}  // namespace myotact::simulation
