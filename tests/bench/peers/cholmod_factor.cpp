#include "cholmod_factor.h"

namespace myotact::peers {
namespace {

/// CHOLMOD reads the lower triangle where it lies; it does not write to it.
cholmod_sparse view(const simulation::BlockMatrix& matrix) {
  const Eigen::SparseMatrix<double>& lower = matrix.lower();
  cholmod_sparse result{};
  result.nrow = result.ncol = static_cast<std::size_t>(lower.cols());
  result.nzmax = static_cast<std::size_t>(lower.nonZeros());
  result.p = const_cast<int*>(lower.outerIndexPtr());
  result.i = const_cast<int*>(lower.innerIndexPtr());
  result.x = const_cast<double*>(lower.valuePtr());
  result.stype = -1;
  result.itype = CHOLMOD_INT;
  result.xtype = CHOLMOD_REAL;
  result.dtype = CHOLMOD_DOUBLE;
  result.sorted = result.packed = 1;
  return result;
}

}  // namespace

CholmodFactor::CholmodFactor(const simulation::BlockMatrix& pattern, Ordering ordering) {
  cholmod_start(&common_);
  common_.supernodal = CHOLMOD_SUPERNODAL;
  common_.nmethods = 1;
  common_.method[0].ordering = ordering == Ordering::Amd ? CHOLMOD_AMD : CHOLMOD_METIS;
  common_.print = 0;
  cholmod_sparse matrix = view(pattern);
  factor_ = cholmod_analyze(&matrix, &common_);
}

CholmodFactor::~CholmodFactor() {
  cholmod_free_factor(&factor_, &common_);
  cholmod_finish(&common_);
}

bool CholmodFactor::factor(const simulation::BlockMatrix& matrix) {
  cholmod_sparse values = view(matrix);
  return cholmod_factorize(&values, factor_, &common_) != 0 && common_.status == CHOLMOD_OK;
}

Eigen::VectorXd CholmodFactor::solve(const Eigen::VectorXd& right) {
  cholmod_dense side{};
  side.nrow = side.d = side.nzmax = static_cast<std::size_t>(right.size());
  side.ncol = 1;
  side.x = const_cast<double*>(right.data());
  side.xtype = CHOLMOD_REAL;
  side.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* answer = cholmod_solve(CHOLMOD_A, factor_, &side, &common_);
  const Eigen::VectorXd result = Eigen::Map<const Eigen::VectorXd>(static_cast<double*>(answer->x), right.size());
  cholmod_free_dense(&answer, &common_);
  return result;
}

}  // namespace myotact::peers
