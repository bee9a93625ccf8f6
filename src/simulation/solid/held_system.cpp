#include "simulation/solid/held_system.h"

#include <algorithm>

namespace myotact::simulation {

HeldSystem::HeldSystem(const Solid& solid, std::span<const HeldDof> held)
    : held_(static_cast<std::size_t>(solid.rest_m().size()), 0) {
  for (const HeldDof& dof : held)
    held_[3 * static_cast<std::size_t>(dof.node) + static_cast<std::size_t>(dof.component)] = 1;
  const Eigen::SparseMatrix<double>& lower = solid.pattern().lower();
  for (int column = 0; column < lower.cols(); ++column) {
    for (int k = lower.outerIndexPtr()[column]; k < lower.outerIndexPtr()[column + 1]; ++k) {
      const int row = lower.innerIndexPtr()[k];
      if (!is_held(row) && !is_held(column)) continue;
      (row == column ? diagonals_ : zeros_).push_back(k);
    }
  }
}

void HeldSystem::drop_held(Eigen::VectorXd& values) const {
  for (std::size_t k = 0; k < held_.size(); ++k) {
    if (held_[k] != 0) values[static_cast<Eigen::Index>(k)] = 0.0;
  }
}

void HeldSystem::hold(BlockMatrix& matrix) const {
  double* values = matrix.values();
  for (const int k : zeros_) values[k] = 0.0;
  for (const int k : diagonals_) values[k] = values[k] > 0.0 ? values[k] : 1.0;  // of the size of its neighbours
}

}  // namespace myotact::simulation
