#pragma once

#include <functional>
#include <vector>

#include "simulation/solid/held_system.h"
#include "simulation/solid/pressure.h"

namespace myotact::simulation {

/// Everything that acts on a solid, at full load.
struct SolidLoads {
  std::vector<HeldDof> held;           // at least what keeps the body from moving freely
  Eigen::VectorXd nodal_force_N;       // dead load, 3 numbers a node; empty: none
  std::vector<PressureFace> pressure;  // follows the surface
  Vec3 gravity_m_s2 = Vec3::Zero();    // frame of the mesh
  double activation = 0.0;             // 0 .. 1; grows with the load, too
};

/// A solid with its loads, for one call.
struct LoadedSolid {
  const Solid& solid;
  const SolidLoads& loads;
};

/// Forces that nothing balances yet, at positions x under a share of the load: internal minus external. The tangent is
/// that of these forces. Held components are not dropped: there the forces are the supports' reactions. Overwrites
/// `out`.
void out_of_balance(const LoadedSolid& loaded, double load, const Eigen::VectorXd& position_m, Solid::Tangent tangent,
                    Solid::Evaluation& out);

/// When solve_static() is content, and how long it tries.
struct StaticOptions {
  double tolerance = 1e-8;   // residual over elements' and nodal forces, or Newton step over the body's size
  int load_steps = 1;        // the least number; more are taken where one does not converge
  int most_iterations = 60;  // Newton steps of one load step
  /// Called after each Newton step with the share of the load that is being applied and the residual share; may be
  /// empty.
  std::function<void(double load, double residual_share)> progress;
};

/// Outcome of solve_static().
struct StaticResult {
  bool converged = false;       // at full load
  int load_steps = 0;           // that converged
  int iterations = 0;           // Newton steps in all
  double load = 0.0;            // share of the load that is in equilibrium
  double residual_share = 0.0;  // residual over elements' and nodal forces, at `load`
  Eigen::VectorXd position_m;   // of the last converged state
  Eigen::VectorXd reaction_N;   // at held components, zero elsewhere: force that the support exerts on the solid
};

/// Static equilibrium from `start_m` (positions, e.g. those at rest) under growing load, by Newton's method with a line
/// search; a tangent that is not positive definite is projected. A load step that fails is halved, at most ten times;
/// then the result holds the last converged state and `converged` is false.
StaticResult solve_static(const Solid& solid, const SolidLoads& loads, const Eigen::VectorXd& start_m,
                          const StaticOptions& options);

}  // namespace myotact::simulation
