#include "measure/line_limb.h"

#include "simulation/line/line_model.h"
#include "simulation/skeleton/skeleton_loads.h"

namespace myotact::measure {

namespace {

anatomy::Muscle without_mesh(const anatomy::Muscle& whole) {
  anatomy::Muscle muscle;
  muscle.key = whole.key;
  muscle.peak_force_N = whole.peak_force_N;
  muscle.optimal_fibre_m = whole.optimal_fibre_m;
  muscle.pennation_rad = whole.pennation_rad;
  muscle.rest_stretch = whole.rest_stretch;
  muscle.tendon_slack_m = whole.tendon_slack_m;
  return muscle;
}

/// What the lines do in one pose, without their activations.
struct LinePose {
  std::vector<simulation::LineGeometry> geometry;  // one a line
  std::vector<double> elongation_m;                // from the file pose
};

LinePose measure_lines(const anatomy::Specimen& specimen, std::span<const double> angles_rad) {
  simulation::Skeleton skeleton(specimen);
  LinePose pose;
  pose.geometry.resize(specimen.lines.size());
  const std::vector<double> file_pose(angles_rad.size(), 0.0);
  skeleton.set_pose(file_pose);
  for (std::size_t i = 0; i < specimen.lines.size(); ++i) {
    simulation::measure_line(specimen.lines[i], skeleton, pose.geometry[i]);
    pose.elongation_m.push_back(-pose.geometry[i].length_m);
  }
  skeleton.set_pose(angles_rad);
  for (std::size_t i = 0; i < specimen.lines.size(); ++i) {
    simulation::measure_line(specimen.lines[i], skeleton, pose.geometry[i]);
    pose.elongation_m[i] += pose.geometry[i].length_m;
  }
  return pose;
}

}  // namespace

anatomy::Specimen lines_of(const anatomy::Specimen& whole) {
  anatomy::Specimen specimen;
  specimen.name = whole.name;
  specimen.bodies = whole.bodies;
  specimen.joints = whole.joints;
  specimen.lines = whole.lines;
  for (const anatomy::Muscle& muscle : whole.muscles) specimen.muscles.push_back(without_mesh(muscle));
  return specimen;
}

LineLimb line_limb(const scene::Scene& scene) {
  return {lines_of(scene.specimen), *scene.co_contraction, scene.activations};
}

double balanced_line_stiffness_Nm_rad(const LineLimb& limb, std::span<const double> angles_rad, double common) {
  const LinePose pose = measure_lines(limb.specimen, angles_rad);
  const auto terms = [&](std::size_t line, double activation) {
    const auto& muscle = limb.specimen.muscles[static_cast<std::size_t>(limb.specimen.lines[line].muscle)];
    const auto force = simulation::line_force(muscle, pose.elongation_m[line], 0.0, activation);
    return simulation::line_joint_terms(pose.geometry[line], force, limb.set.joint);
  };
  // A line's torque is linear in its activation, so that two levels are enough.
  scene::TorqueTable table{{0.0, 1.0},
                           std::vector<std::vector<double>>(limb.specimen.muscles.size(), std::vector<double>(2, 0.0))};
  for (std::size_t line = 0; line < pose.geometry.size(); ++line) {
    auto& row = table.torque_Nm[static_cast<std::size_t>(limb.specimen.lines[line].muscle)];
    for (std::size_t level = 0; level < 2; ++level) row[level] = terms(line, table.levels[level]).torque_Nm;
  }
  scene::CoContraction set = limb.set;
  set.common = common;
  const scene::Balance levels = scene::balance(table, set, limb.activations);
  const std::vector<double> activations = scene::driven_activations(limb.set, levels, limb.activations);
  double sum_Nm_rad = 0.0;
  for (std::size_t line = 0; line < pose.geometry.size(); ++line) {
    const auto muscle = static_cast<std::size_t>(limb.specimen.lines[line].muscle);
    sum_Nm_rad += terms(line, activations[muscle]).stiffness_Nm_rad();
  }
  return sum_Nm_rad;
}

double weight_stiffness_Nm_rad(const LineLimb& limb, std::span<const double> angles_rad, const Vec3& gravity_m_s2) {
  simulation::Skeleton skeleton(limb.specimen);
  skeleton.set_pose(angles_rad);
  const std::vector<double> none(angles_rad.size(), 0.0);
  simulation::SkeletonLoads loads;
  loads.compute(skeleton, {gravity_m_s2, none, none});
  return loads.stiffness_Nm_rad(limb.set.joint, limb.set.joint) - loads.passive_Nm_rad[limb.set.joint];
}

}  // namespace myotact::measure
