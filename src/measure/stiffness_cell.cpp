#include "measure/stiffness_cell.h"

#include <algorithm>
#include <cmath>

#include "measure/stiffness_band.h"
#include "measure/stiffness_reason.h"

namespace myotact::measure {

namespace {

/// One cell while it is measured.
class Cell {
 public:
  Cell(const CellPlace& place, simulation::Simulation& simulation)
      : place_(place),
        set_(*place.scene.co_contraction),
        simulation_(simulation),
        angles_(angles_at(place.scene, place.q_rad)) {
    set_.common = place.common;
  }

  StiffnessRow measure() {
    simulation_.restart();
    hold();
    read();
    perturb();
    add_band();
    row_.why = explain_stiffness(row_);
    return row_;
  }

 private:
  double settled_torque_Nm(double q_rad);
  double stronger_side_Nm() const;
  void hold();
  void read();
  void perturb();
  void add_band();

  const CellPlace& place_;
  scene::CoContraction set_;
  simulation::Simulation& simulation_;
  std::vector<double> angles_;  // one a joint
  std::vector<double> activations_;
  StiffnessRow row_;
};

/// Net torque of all muscles in equilibrium at an angle.
double Cell::settled_torque_Nm(double q_rad) {
  std::vector<double> angles = angles_;
  angles[static_cast<std::size_t>(set_.joint)] = q_rad;
  row_.converged &= simulation_.settle(angles, activations_);
  return simulation_.joint(set_.joint).net_torque_Nm;
}

double Cell::stronger_side_Nm() const {
  double larger_Nm = 0.0;
  for (const auto* side : {&set_.flexors, &set_.extensors}) {
    double sum_Nm = 0.0;
    for (const int m : *side) sum_Nm += simulation_.muscle_torque_Nm(m, set_.joint);
    larger_Nm = std::max(larger_Nm, std::abs(sum_Nm));
  }
  return larger_Nm;
}

/// The table interpolates between its levels: what that leaves over is asked back from it, by secant steps on the
/// torque of the settled tissue. The difference is added to the finished balance, which it is meant to disturb.
void Cell::hold() {
  constexpr int kMostRefinements = 3;
  // Well below what counts as held: beside solves from the file pose one more settle costs nothing that could be
  // measured, and on the canine elbow K still moves by 0.1 % with a net torque of kHeldShare.
  constexpr double kRefinedShare = 1e-5;
  scene::CoContraction balanced = set_;
  balanced.difference = 0.0;
  double wanted_Nm = 0.0, last_wanted_Nm = 0.0, last_net_Nm = 0.0;
  row_.converged = true;
  scene::Balance levels;
  for (int refinement = 0;; ++refinement) {
    levels = scene::balance(place_.table, balanced, place_.scene.activations, wanted_Nm);
    activations_ = scene::driven_activations(set_, levels, place_.scene.activations);
    row_.converged = true;  // only the state that is read counts
    const double net_Nm = settled_torque_Nm(place_.q_rad);
    row_.held = std::abs(net_Nm) <= kHeldShare * stronger_side_Nm();
    if (std::abs(net_Nm) <= kRefinedShare * stronger_side_Nm() || !levels.held || !std::isfinite(net_Nm) ||
        refinement == kMostRefinements)
      break;
    const double slope = refinement == 0 ? 1.0 : (net_Nm - last_net_Nm) / (wanted_Nm - last_wanted_Nm);
    last_wanted_Nm = wanted_Nm;
    last_net_Nm = net_Nm;
    if (!(slope > 0.0)) break;
    wanted_Nm -= net_Nm / slope;
  }
  row_.flexors = std::clamp(levels.flexors + std::max(set_.difference, 0.0), 0.0, 1.0);
  row_.extensors = std::clamp(levels.extensors + std::max(-set_.difference, 0.0), 0.0, 1.0);
  if (set_.difference == 0.0) return;
  levels = {row_.flexors, row_.extensors, levels.held};
  activations_ = scene::driven_activations(set_, levels, place_.scene.activations);
  settled_torque_Nm(place_.q_rad);
}

void Cell::read() {
  const simulation::JointReadout readout = simulation_.joint(set_.joint);
  row_.joint = place_.scene.specimen.joints[static_cast<std::size_t>(set_.joint)].key;
  row_.q_rad = place_.q_rad;
  row_.common = place_.common;
  row_.difference = set_.difference;
  row_.K_schur_Nm_rad = readout.stiffness_Nm_rad;
  row_.K_muscle_Nm_rad = readout.line_muscle_Nm_rad;
  row_.K_geometry_Nm_rad = readout.line_geometry_Nm_rad;
  row_.K_contact_Nm_rad = readout.contact_Nm_rad;
  row_.K_passive_Nm_rad = readout.passive_Nm_rad;
  row_.K_line_Nm_rad = row_.K_muscle_Nm_rad + row_.K_geometry_Nm_rad + row_.K_passive_Nm_rad;
  row_.net_torque_Nm = readout.net_torque_Nm;
  row_.preview = readout.preview;
  if (const int m = simulation_.stuck_line(); m >= 0)
    row_.stuck_line = place_.scene.specimen.muscles[static_cast<std::size_t>(m)].key;
  for (std::size_t m = 0; m < activations_.size(); ++m) {
    const simulation::MuscleAtJoint part = simulation_.muscle_at_joint(static_cast<int>(m), set_.joint);
    if (part.torque_Nm == 0.0 && part.line_muscle_Nm_rad == 0.0 && part.line_geometry_Nm_rad == 0.0) continue;
    row_.muscles.push_back({place_.scene.specimen.muscles[m].key, activations_[m], part.torque_Nm,
                            part.stiffness_Nm_rad, part.line_muscle_Nm_rad, part.line_geometry_Nm_rad});
  }
}

/// The torque of re-equilibrated tissue a little below and above the angle, activations held.
void Cell::perturb() {
  const double below_Nm = settled_torque_Nm(place_.q_rad - kPerturbation_rad);
  const double above_Nm = settled_torque_Nm(place_.q_rad + kPerturbation_rad);
  row_.K_perturbed_Nm_rad = -(above_Nm - below_Nm) / (2.0 * kPerturbation_rad) + row_.K_passive_Nm_rad;
}

void Cell::add_band() {
  row_.band = stiffness_band(place_.lines, angles_, place_.common);
  const BandPart whole = whole_band(row_.band);
  row_.K_low_Nm_rad = row_.K_schur_Nm_rad - whole.down_Nm_rad;
  row_.K_high_Nm_rad = row_.K_schur_Nm_rad + whole.up_Nm_rad;
  row_.K_gravity_Nm_rad = weight_stiffness_Nm_rad(place_.lines, angles_, place_.scene.settings.gravity_m_s2);
}

}  // namespace

std::vector<double> angles_at(const scene::Scene& scene, double q_rad) {
  std::vector<double> angles;
  for (const auto& setting : scene.joints) angles.push_back(setting.angle_rad);
  angles[static_cast<std::size_t>(scene.co_contraction->joint)] = q_rad;
  return angles;
}

scene::TorqueTable torques_at(const scene::Scene& scene, simulation::Simulation& simulation, double q_rad) {
  simulation.restart();
  return scene::measure_torques(scene, simulation, angles_at(scene, q_rad));
}

StiffnessRow measure_cell(const CellPlace& place, simulation::Simulation& simulation) {
  return Cell(place, simulation).measure();
}

}  // namespace myotact::measure
