#pragma once

#include <Eigen/LU>

#include "simulation/limb/limb.h"
#include "simulation/worker_pool.h"

namespace myotact::simulation {

// Muscles in contact share their equations: beside each one's own matrix stand the blocks -k n n^T between its nodes
// and its neighbours'. They are few and soft, so each muscle keeps its own factor; conjugate gradients with all those
// factors, and the small system's, as their preconditioner bring in the rest. The sums run in the muscles' order.

/// Some muscle touches a neighbour in the tangent computed last.
bool touches_neighbours(const Limb& limb);

/// Puts the coupling between muscles into a Newton step whose muscles are eliminated (free_solution, borders,
/// border_solution) and whose small system is factored. `solution` is the small system's without coupling and becomes
/// the one with it; what changes in the muscles' own solutions goes to `coupled_m`, empty where there is no coupling.
/// Goes on until the equations leave less in each muscle than `share` of the size of its forces, for
/// 30 rounds at most, or until the whole is not positive definite; then `solution` is the best so far.
void couple_step(Limb& limb, const Eigen::PartialPivLU<Eigen::MatrixXd>& small, double share, Eigen::VectorXd& solution,
                 WorkerPool& workers);

/// Minus what the nodes of all muscles do when joints rotate by one radian each, tissue following in equilibrium with
/// its neighbours: solves (matrix + mean + coupling) follow = coupling_N_rad, from and into the muscles'
/// `follow_m_rad`, which hold the solutions without coupling. After compute_system() and factor_system() of accuracy
/// Refined. False when it did not get there.
bool couple_follow(Limb& limb, WorkerPool& workers);

/// Takes from `right` (free dofs x joints) what the neighbours of a muscle pull on it when they follow the joints as in
/// their last stiffness.
void subtract_followed_coupling(const Limb& limb, const LimbMuscle& muscle, Eigen::MatrixXd& right);

}  // namespace myotact::simulation
