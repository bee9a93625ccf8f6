#include "measure/stiffness_sweep.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/text.h"
#include "messages/scene_frame.h"

namespace myotact::measure {

namespace {

std::vector<double> angles_of(const scene::Scene& scene, int joint, double q_rad) {
  std::vector<double> angles;
  for (const auto& setting : scene.joints) angles.push_back(setting.angle_rad);
  angles[static_cast<std::size_t>(joint)] = q_rad;
  return angles;
}

/// Activations of all muscles with the co-contraction's two sides at the given levels.
std::vector<double> activations_of(const scene::Scene& scene, const scene::Balance& levels) {
  std::vector<double> activations = scene.activations;
  for (const int m : scene.co_contraction->flexors) activations[static_cast<std::size_t>(m)] = levels.flexors;
  for (const int m : scene.co_contraction->extensors) activations[static_cast<std::size_t>(m)] = levels.extensors;
  return activations;
}

/// The table interpolates between its levels; a few secant steps on the static solve remove what is left.
scene::Balance refine_balance(const scene::Scene& scene, const scene::TorqueTable& table,
                              simulation::Simulation& simulation, const std::vector<double>& angles, double common) {
  constexpr int kCorrections = 3;
  scene::CoContraction set = *scene.co_contraction;
  set.common = common;
  double wanted_Nm = 0.0;
  scene::Balance levels = scene::balance(table, set, scene.activations, wanted_Nm);
  for (int i = 0; i < kCorrections; ++i) {
    if (!levels.held || !simulation.settle(angles, activations_of(scene, levels))) break;
    wanted_Nm -= simulation.joint(set.joint).net_torque_Nm;
    levels = scene::balance(table, set, scene.activations, wanted_Nm);
  }
  return levels;
}

/// Net torque of everything that acts about the joint at an angle near the settled one, activations held.
double torque_at(const scene::Scene& scene, simulation::Simulation& simulation, double q_rad,
                 const std::vector<double>& activations, bool& converged) {
  const int joint = scene.co_contraction->joint;
  converged &= simulation.settle(angles_of(scene, joint, q_rad), activations);
  return simulation.joint(joint).net_torque_Nm;
}

StiffnessRow measure_row(const scene::Scene& scene, const scene::TorqueTable& table, simulation::Simulation& simulation,
                         double q_rad, double common) {
  const int joint = scene.co_contraction->joint;
  const auto angles = angles_of(scene, joint, q_rad);
  const scene::Balance levels = refine_balance(scene, table, simulation, angles, common);
  const std::vector<double> activations = activations_of(scene, levels);
  StiffnessRow row;
  row.converged = simulation.settle(angles, activations);
  simulation.refresh_stiffness(joint);
  const simulation::JointReadout readout = simulation.joint(joint);
  double stronger_Nm = 0.0;
  for (const int m : scene.co_contraction->flexors) stronger_Nm += simulation.muscle_torque_Nm(m, joint);
  const double below = torque_at(scene, simulation, q_rad - kPerturbation_rad, activations, row.converged);
  const double above = torque_at(scene, simulation, q_rad + kPerturbation_rad, activations, row.converged);
  row.joint = scene.specimen.joints[static_cast<std::size_t>(joint)].key;
  row.q_rad = q_rad;
  row.common = common;
  row.difference = scene.co_contraction->difference;
  row.K_schur_Nm_rad = readout.stiffness_Nm_rad;
  row.K_perturbed_Nm_rad = -(above - below) / (2.0 * kPerturbation_rad) + readout.passive_Nm_rad;
  row.K_muscle_Nm_rad = readout.line_muscle_Nm_rad;
  row.K_geometry_Nm_rad = readout.line_geometry_Nm_rad;
  row.K_contact_Nm_rad = readout.contact_Nm_rad;
  row.K_passive_Nm_rad = readout.passive_Nm_rad;
  row.K_line_Nm_rad = row.K_muscle_Nm_rad + row.K_geometry_Nm_rad + row.K_passive_Nm_rad;
  row.net_torque_Nm = readout.net_torque_Nm;
  row.preview = readout.preview;
  row.held = levels.held && std::abs(row.net_torque_Nm) <= 0.01 * std::max(std::abs(stronger_Nm), 0.01);
  return row;
}

}  // namespace

std::vector<StiffnessRow> sweep_stiffness(const scene::Scene& scene, simulation::Simulation& simulation, double q_rad,
                                          const std::vector<double>& levels) {
  if (!scene.co_contraction) {
    throw bad_data(scene.name, "/co_contraction", "is missing; name the joint and its groups to measure stiffness");
  }
  const int joint = scene.co_contraction->joint;
  const auto table = scene::measure_torques(scene, simulation, angles_of(scene, joint, q_rad));
  std::vector<StiffnessRow> rows;
  for (const double level : levels) rows.push_back(measure_row(scene, table, simulation, q_rad, level));
  return rows;
}

std::string stiffness_csv(const std::vector<StiffnessRow>& rows) {
  std::string csv =
      "joint,q_rad,common,difference,K_schur_Nm_rad,K_perturbed_Nm_rad,K_line_Nm_rad,net_torque_Nm,K_muscle_Nm_rad,"
      "K_geometry_Nm_rad,K_contact_Nm_rad,K_passive_Nm_rad,held,converged\n";
  for (const StiffnessRow& r : rows) {
    csv += r.joint;
    for (const double value :
         {r.q_rad, r.common, r.difference, r.K_schur_Nm_rad, r.K_perturbed_Nm_rad, r.K_line_Nm_rad, r.net_torque_Nm,
          r.K_muscle_Nm_rad, r.K_geometry_Nm_rad, r.K_contact_Nm_rad, r.K_passive_Nm_rad}) {
      csv += ',' + to_text(value);
    }
    csv += r.held ? ",1" : ",0";
    csv += r.converged ? ",1\n" : ",0\n";
  }
  return csv;
}

std::string stiffness_json(const std::vector<StiffnessRow>& rows) {
  nlohmann::json list = nlohmann::json::array();
  for (const StiffnessRow& r : rows) {
    list.push_back({{"joint", r.joint},
                    {"q_rad", r.q_rad},
                    {"common", r.common},
                    {"difference", r.difference},
                    {"K_schur_Nm_rad", r.K_schur_Nm_rad},
                    {"K_perturbed_Nm_rad", r.K_perturbed_Nm_rad},
                    {"K_line_Nm_rad", r.K_line_Nm_rad},
                    {"net_torque_Nm", r.net_torque_Nm},
                    {"K_muscle_Nm_rad", r.K_muscle_Nm_rad},
                    {"K_geometry_Nm_rad", r.K_geometry_Nm_rad},
                    {"K_contact_Nm_rad", r.K_contact_Nm_rad},
                    {"K_passive_Nm_rad", r.K_passive_Nm_rad},
                    {"held", r.held ? 1 : 0},
                    {"converged", r.converged ? 1 : 0}});
    if (r.preview) list.back()["mark"] = messages::kPreviewMark;
  }
  return list.dump(2) + "\n";
}

}  // namespace myotact::measure
