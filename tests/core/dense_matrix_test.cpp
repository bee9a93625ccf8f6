#include "core/dense_matrix.h"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

// Against matrices whose decompositions are known in closed form, and against Eigen's own of another kind.

namespace myotact {
namespace {

constexpr double kRounding = 1e-12;

/// The second difference of n points with fixed ends: eigenvalues 2 - 2 cos(k pi / (n + 1)).
Eigen::MatrixXd second_difference(Eigen::Index n) {
  Eigen::MatrixXd matrix = 2.0 * Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i + 1 < n; ++i) matrix(i, i + 1) = matrix(i + 1, i) = -1.0;
  return matrix;
}

TEST(DenseMatrix, EigenvaluesOfTheSecondDifferenceAscendAsTheClosedFormSays) {
  const Eigen::Index n = 9;
  const SymmetricEigen eigen = symmetric_eigen(second_difference(n));
  for (Eigen::Index k = 0; k < n; ++k) {
    const double angle_rad = static_cast<double>(k + 1) * std::acos(-1.0) / static_cast<double>(n + 1);
    EXPECT_NEAR(eigen.values[k], 2.0 - 2.0 * std::cos(angle_rad), kRounding);
    EXPECT_NEAR(eigen.vectors.col(k).norm(), 1.0, kRounding);
    EXPECT_LT((second_difference(n) * eigen.vectors.col(k) - eigen.values[k] * eigen.vectors.col(k)).norm(), kRounding);
  }
}

TEST(DenseMatrix, OnlyTheLowerTriangleIsRead) {
  Eigen::MatrixXd matrix = second_difference(4);
  matrix(0, 3) = 1e9;
  EXPECT_LT((symmetric_eigen(matrix).values - symmetric_eigen(second_difference(4)).values).norm(), kRounding);
}

TEST(DenseMatrix, ThePositivePartKeepsWhatIsPositiveAndLosesTheRest) {
  const Eigen::MatrixXd definite = second_difference(5);
  EXPECT_LT((positive_part(symmetric_eigen(definite)) - definite).norm(), kRounding);
  EXPECT_LT(positive_part(symmetric_eigen(-definite)).norm(), kRounding);
  const Eigen::MatrixXd shifted = definite - 2.0 * Eigen::MatrixXd::Identity(5, 5);
  // A = A+ - A-, both without negative eigenvalues and with no direction in common.
  const Eigen::MatrixXd above = positive_part(symmetric_eigen(shifted));
  const Eigen::MatrixXd below = positive_part(symmetric_eigen(-shifted));
  EXPECT_LT((above - below - shifted).norm(), kRounding);
  EXPECT_LT((above * below).norm(), kRounding);
  EXPECT_GT(above.norm(), 1.0);
}

TEST(DenseMatrix, LeastSquaresIsTheSolutionOfTheNormalEquations) {
  Eigen::MatrixXd A(5, 2);
  A << 1, 0, 1, 1, 1, 2, 1, 3, 1, 4;
  Eigen::VectorXd b(5);
  b << 1.1, 2.9, 5.2, 6.8, 9.0;
  // A straight line through five points: slope and intercept by the textbook's sums.
  EXPECT_LT((least_squares(A, b) - Eigen::Vector2d(1.06, 1.97)).norm(), kRounding);
}

TEST(DenseMatrix, DependentColumnsStillLeaveTheSmallestResidual) {
  Eigen::MatrixXd A(3, 2);
  A << 1, 2, 1, 2, 1, 2;
  const Eigen::Vector3d b(1.0, 2.0, 6.0);
  EXPECT_NEAR((A * least_squares(A, b) - b).norm(), std::sqrt(14.0), kRounding);
}

TEST(DenseMatrix, SolvesForEveryColumn) {
  const Eigen::Index n = 7;
  const Eigen::MatrixXd A = second_difference(n) + Eigen::MatrixXd::Constant(n, n, 0.1);
  const Eigen::MatrixXd expected = A.inverse();
  EXPECT_LT((solve_dense(A, Eigen::MatrixXd::Identity(n, n)) - expected).norm(), 1e-10);
  Eigen::MatrixXd swapped(2, 2);  // no pivot on its diagonal
  swapped << 0, 1, 2, 0;
  EXPECT_LT((solve_dense(swapped, Eigen::Vector2d(3.0, 4.0)) - Eigen::Vector2d(2.0, 3.0)).norm(), kRounding);
}

}  // namespace
}  // namespace myotact
