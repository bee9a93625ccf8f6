#pragma once

#include <vector>

#include "measure/line_limb.h"
#include "measure/stiffness_row.h"
#include "scene/co_contraction.h"
#include "simulation/simulation.h"

namespace myotact::measure {

/// Half the angle between the two perturbed states. Small against the degree over which K changes, large against the
/// static solver's residual.
inline constexpr double kPerturbation_rad = 0.5 * 0.017453292519943295;

/// A balance holds when the net torque of the muscles is below this part of the stronger side's: a tenth of the percent
/// to which the ways of finding K agree.
inline constexpr double kHeldShare = 1e-3;

/// Where a cell of the sweep is, with what all cells of its angle share.
struct CellPlace {
  const scene::Scene& scene;  // with a co_contraction
  const LineLimb& lines;      // of the scene
  const scene::TorqueTable& table;
  double q_rad = 0.0;
  double common = 0.0;
};

/// Angles of all joints: the scene's, that of the co-contraction at `q_rad`.
std::vector<double> angles_at(const scene::Scene& scene, double q_rad);

/// Static torques at one angle, from the file pose.
scene::TorqueTable torques_at(const scene::Scene& scene, simulation::Simulation& simulation, double q_rad);

/// One row: balances the joint on really settled torques, then measures stiffness and its parts. Starts from the file
/// pose, so that it does not depend on what the simulation did before. Never throws for tissue that does not settle:
/// `converged` and `held` report it.
StiffnessRow measure_cell(const CellPlace& place, simulation::Simulation& simulation);

}  // namespace myotact::measure
