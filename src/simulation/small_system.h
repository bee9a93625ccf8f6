#pragma once

#include <vector>

#include "simulation/limb.h"

namespace myotact::simulation {

/// The unknowns of the small system: angles of the joints that may turn, then 3 numbers a spring.
struct SmallSystem {
  std::vector<int> joints;
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;

  Eigen::Index size() const { return right.size(); }
  Eigen::Index spring_row(std::size_t spring) const { return static_cast<Eigen::Index>(joints.size() + 3 * spring); }
};

/// Free: those that may turn. Held: none does, whatever pulls.
enum class Joints { Free, Held };

/// All zero, of the right size.
SmallSystem make_small_system(const Limb& limb, Joints joints);

/// Tangent, factor, border solutions of one muscle. A muscle that the first Newton step has balanced keeps its tangent
/// in the later ones: only its residual is new. It is cheap, and the muscles that are out of balance set the pace.
void eliminate(const Limb& limb, const SmallSystem& small, TissueLoad load, int index, LimbMuscle& muscle);

/// Out-of-balance torque of the bones themselves at the present angles; fills limb.loads.
Eigen::VectorXd skeleton_residual(Limb& limb, const TimeRule& rule);

/// Bones, eliminated muscles, lines and springs; also the springs' compliances.
void add_up(Limb& limb, const TimeRule& rule, SmallSystem& small);

}  // namespace myotact::simulation
