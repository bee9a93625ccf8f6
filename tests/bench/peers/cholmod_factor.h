#pragma once

#include <Eigen/Core>
#include <suitesparse/cholmod.h>

#include "simulation/linear/block_matrix.h"

namespace myotact::peers {

/// L L^T by SuiteSparse's CHOLMOD: the pattern is analysed once, the numbers are factored each time.
class CholmodFactor {
 public:
  /// Minimum degree, or nested dissection by METIS.
  enum class Ordering { Amd, Metis };
  CholmodFactor(const simulation::BlockMatrix& pattern, Ordering ordering);
  ~CholmodFactor();
  CholmodFactor(const CholmodFactor&) = delete;
  CholmodFactor& operator=(const CholmodFactor&) = delete;

  /// False when the matrix is not positive definite.
  bool factor(const simulation::BlockMatrix& matrix);
  Eigen::VectorXd solve(const Eigen::VectorXd& right);
  double numbers() const { return common_.lnz; }  // in L

 private:
  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
};

}  // namespace myotact::peers
