#pragma once

#include <string>
#include <vector>

#include "scene/co_contraction.h"
#include "scene/scene_file.h"
#include "simulation/simulation.h"

namespace myotact::measure {

/// One row of stiffness.csv (FORMATS: Tables).
struct StiffnessRow {
  std::string joint;
  double q_rad = 0.0;
  double common = 0.0, difference = 0.0;
  double K_schur_Nm_rad = 0.0;      // of the quasi-static system
  double K_perturbed_Nm_rad = 0.0;  // from the torque at q -+ the perturbation, activations held
  double K_line_Nm_rad = 0.0;       // of the muscle lines alone, passive joint included
  double net_torque_Nm = 0.0;
  double K_muscle_Nm_rad = 0.0, K_geometry_Nm_rad = 0.0;  // the lines' two parts
  double K_contact_Nm_rad = 0.0;                          // of the tissue: lost if contact forces were held
  double K_passive_Nm_rad = 0.0;
  bool held = false;       // net torque balanced to within 1 % of the stronger side's
  bool converged = false;  // every static solve of the row did
  bool preview = false;    // mass-spring muscles have a part in it
};

/// Half the angle between the two perturbed states. Small against the degree over which K changes, large against the
/// static solver's residual.
inline constexpr double kPerturbation_rad = 0.5 * 0.017453292519943295;

/// Joint stiffness against co-contraction at one angle of the scene's co-contraction joint; the balance is solved anew
/// at the angle. Throws Error BadData when the scene has no co_contraction.
std::vector<StiffnessRow> sweep_stiffness(const scene::Scene& scene, simulation::Simulation& simulation, double q_rad,
                                          const std::vector<double>& levels);

std::string stiffness_csv(const std::vector<StiffnessRow>& rows);
/// Rows of a preview carry `mark`; the columns of the CSV are fixed.
std::string stiffness_json(const std::vector<StiffnessRow>& rows);

}  // namespace myotact::measure
