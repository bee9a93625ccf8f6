#pragma once

#include <vector>

#include "simulation/limb/limb.h"

namespace myotact::simulation {

/// The dense system that is left when all muscles' nodes are eliminated: matrix x = right. Unknowns: changes of the
/// angles of the joints that may rotate, then the force of each spring [N, world].
struct SmallSystem {
  std::vector<int> joints;  // that may rotate, in the order of their rows
  Eigen::MatrixXd matrix;   // symmetric, indefinite: negative in the springs' block
  Eigen::VectorXd right;    // minus the residual

  Eigen::Index size() const { return right.size(); }  // unknowns
  /// First of the three rows of a spring of the limb's list.
  Eigen::Index spring_row(std::size_t spring) const { return static_cast<Eigen::Index>(joints.size() + 3 * spring); }
};

/// Which joints are unknowns. Free: those that may rotate. Held: none, whatever pulls.
enum class Joints { Free, Held };

/// All zero, of the right size.
SmallSystem make_small_system(const Limb& limb, Joints joints);

/// Tangent, factor, border solutions of one muscle. A muscle that the first Newton step has balanced keeps its tangent
/// in the later ones: only its residual is new. It is cheap, and the muscles that are out of balance set the pace. One
/// that has hardly changed (`kept_rule`) keeps that of an earlier step: forces and springs are new.
/// `sound` states whether it worked, `made_definite` whether the tangent is the safe one. `index`: of the muscle.
/// Different muscles may be eliminated by different threads at once.
void eliminate(const Limb& limb, const SmallSystem& small, TissueLoad load, int index, LimbMuscle& muscle);

/// Out-of-balance torque (inertia minus forces, one a joint) of the bones themselves at the present angles, after a
/// step by `rule`; fills limb.loads.
Eigen::VectorXd skeleton_residual(Limb& limb, const TimeRule& rule);

/// Lets every contact press again, before the next system is made: one that pulled by a first tangent may press by the
/// next, and would else be passed through until the step ends.
void close_springs(Limb& limb);

/// Opens, where several points hold a sphere, the spring that pulls hardest at what it should press, by the forces of
/// this solution. True when there was one: then the system has to be added up anew.
bool open_pulling(Limb& limb, const Eigen::VectorXd& solution, const SmallSystem& small);

/// Bones, eliminated muscles, lines and springs, in place of what was there; also sets the springs' compliances.
void add_up(Limb& limb, const TimeRule& rule, SmallSystem& small);

}  // namespace myotact::simulation
