#pragma once

#include <Eigen/Core>

/// Decompositions of small dense matrices, compiled once: Eigen's templates for them are the slowest part of every
/// source that names them. All functions may be called from any thread; none is real-time safe, since they allocate.
namespace myotact {

struct SymmetricEigen {
  Eigen::VectorXd values;   // n, ascending
  Eigen::MatrixXd vectors;  // n x n, a unit vector a column
};

/// Of an n x n matrix, n > 0, of which the lower triangle is read.
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& symmetric);

/// The nearest matrix (Frobenius) without negative eigenvalues to a symmetric one: what belongs to them is left out.
Eigen::MatrixXd positive_part(const SymmetricEigen& eigen);

/// x of n that minimises |A x - b|, A of m x n; by QR with column pivoting, so that dependent columns do no harm.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// X of n x k with A X = B, A of n x n and not singular; by LU with partial pivoting.
Eigen::MatrixXd solve_dense(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

}  // namespace myotact
