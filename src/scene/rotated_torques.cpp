#include "scene/rotated_torques.h"

#include <algorithm>
#include <functional>

#include "simulation/line/line_tissue.h"

namespace myotact::scene {
namespace {

using simulation::LineGeometry;
using simulation::Skeleton;

/// Torque about `joint` of one muscle's line at an activation, in the pose of `rotated`; `file_pose` is the same
/// skeleton at rest. Positive flexes.
using LineTorque = std::function<double(const Skeleton& rotated, double activation)>;

LineTorque line_torque(const Scene& scene, std::size_t muscle, const Skeleton& file_pose, int joint) {
  const anatomy::Muscle& given = scene.specimen.muscles[muscle];
  const anatomy::MuscleLine& line =
      *std::find_if(scene.specimen.lines.begin(), scene.specimen.lines.end(),
                    [&](const anatomy::MuscleLine& candidate) { return candidate.muscle == static_cast<int>(muscle); });
  const bool soft = scene.settings.tissue[muscle] != simulation::TissueModel::Line;
  if (!soft) {
    const auto tissue = simulation::make_line_tissue(given, line, file_pose, scene.settings.tendon);
    return [tissue, joint](const Skeleton& rotated, double activation) {
      simulation::LineTissue at_rest = tissue;
      return -simulation::evaluate_line_tissue(rotated, simulation::TimeRule{}, activation, at_rest).residual_Nm[joint];
    };
  }
  LineGeometry rest;
  simulation::measure_line(line, file_pose, rest);
  return [&given, &line, rest_m = rest.length_m, joint](const Skeleton& rotated, double activation) {
    LineGeometry now;
    simulation::measure_line(line, rotated, now);
    return -now.slope_m_rad[joint] * simulation::line_force(given, now.length_m - rest_m, 0.0, activation).force_N;
  };
}

}  // namespace

TorqueTable rotated_torques(const TorqueTable& table, const Scene& scene, std::span<const double> measured_rad,
                            std::span<const double> wanted_rad) {
  const CoContraction& set = *scene.co_contraction;
  const Skeleton file_pose(scene.specimen);
  Skeleton measured = file_pose, wanted = file_pose;
  measured.set_pose(measured_rad);
  wanted.set_pose(wanted_rad);
  TorqueTable rotated = table;
  for (std::size_t m = 0; m < table.torque_Nm.size(); ++m) {
    if (scene.settings.tissue[m] == simulation::TissueModel::Rigid) continue;
    const int muscle = static_cast<int>(m);
    const auto drives = [&](const std::vector<int>& side) {
      return std::find(side.begin(), side.end(), muscle) != side.end();
    };
    const bool driven = drives(set.flexors) || drives(set.extensors);
    const LineTorque torque = line_torque(scene, m, file_pose, set.joint);
    for (std::size_t i = 0; i < table.levels.size(); ++i) {
      const double activation = driven ? table.levels[i] : scene.activations[m];
      rotated.torque_Nm[m][i] += torque(wanted, activation) - torque(measured, activation);
    }
  }
  return rotated;
}

}  // namespace myotact::scene
