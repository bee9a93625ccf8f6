#include "simulation/linear/block_factor.h"

#include <random>

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <gtest/gtest.h>

#include "anatomy/specimen.h"
#include "core/data_folder.h"
#include "simulation/limb/limb.h"

namespace myotact::simulation {
namespace {

/// A ladder of overlapping cliques with two long-distance ones: fronts of many sizes.
std::vector<std::vector<int>> ladder(int nodes) {
  std::vector<std::vector<int>> cliques;
  for (int i = 0; i + 4 < nodes; i += 2) cliques.push_back({i, i + 1, i + 2, i + 4, -1});
  cliques.push_back({0, nodes / 2, nodes - 1});
  cliques.push_back({1, nodes / 3});
  return cliques;
}

/// Pairs of a clique, row > column; -1 is no node.
std::vector<std::pair<int, int>> pairs(const std::vector<int>& clique) {
  std::vector<std::pair<int, int>> result;
  for (int row : clique) {
    for (int column : clique) {
      if (column >= 0 && row > column) result.emplace_back(row, column);
    }
  }
  return result;
}

BlockMatrix random_matrix(int nodes, double diagonal) {
  BlockMatrix matrix(nodes, ladder(nodes));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  for (const auto& clique : ladder(nodes)) {
    for (const auto& [row, column] : pairs(clique)) {
      matrix.add(row, column, Mat3::NullaryExpr([&] { return value(random); }));
    }
  }
  for (int node = 0; node < nodes; ++node) matrix.add_diagonal(node, diagonal);
  return matrix;
}

Eigen::MatrixXd dense(const BlockMatrix& matrix) {
  return Eigen::MatrixXd(matrix.lower()).selfadjointView<Eigen::Lower>();
}

/// Factors in single precision: its rounding, 6e-8, times the condition number, here below 10.
constexpr double kSinglePrecision = 1e-6;

/// Plain and refined solutions, each within its own bound.
void expect_solves(const BlockMatrix& matrix) {
  BlockFactor factor(matrix);
  ASSERT_TRUE(factor.factor(matrix));
  const Eigen::MatrixXd wanted = Eigen::MatrixXd::Random(3 * matrix.nodes(), 3);
  const Eigen::MatrixXd right = dense(matrix) * wanted;
  EXPECT_LT((factor.solve(right) - wanted).norm() / wanted.norm(), kSinglePrecision) << matrix.nodes() << " nodes";
  EXPECT_LT((factor.solve_refined(matrix, right) - wanted).norm() / wanted.norm(), 1e-12) << matrix.nodes() << " nodes";
}

}  // namespace

TEST(BlockFactor, SolvesAPositiveDefiniteMatrix) {
  for (int nodes : {5, 11, 60}) expect_solves(random_matrix(nodes, 30.0));
}

TEST(BlockFactor, SolvesAnIndefiniteMatrixAndSaysSo) {
  const BlockMatrix matrix = random_matrix(60, -30.0);
  BlockFactor factor(matrix);
  EXPECT_TRUE(factor.factor(matrix));
  EXPECT_FALSE(factor.positive());
  expect_solves(matrix);
}

TEST(BlockFactor, RefusesASingularMatrixAndOneWithNaN) {
  BlockMatrix matrix = random_matrix(20, 30.0);
  BlockFactor factor(matrix);
  EXPECT_TRUE(factor.factor(matrix));
  EXPECT_TRUE(factor.positive());
  matrix.set_zero();
  EXPECT_FALSE(factor.factor(matrix));
  matrix.add_diagonal(5, std::nan(""));
  EXPECT_FALSE(factor.factor(matrix));
}

double relative_error(const Eigen::MatrixXd& got, const Eigen::MatrixXd& expected) {
  return (got - expected).colwise().norm().cwiseQuotient(expected.colwise().norm()).maxCoeff();
}

TEST(BlockFactor, SolvesRealMusclesNearlyAsWellAsDoublePrecision) {
  const anatomy::Specimen specimen = anatomy::load_specimen(data_folder() / "meshes" / "canine_elbow");
  Limb limb(specimen);
  std::mt19937 random(7);
  std::normal_distribution<double> value;
  for (const TimeRule& rule : {second_order(0.01), TimeRule{}}) {
    TissueLoad load;
    load.rule = rule;
    for (LimbMuscle& muscle : limb.muscles) {
      muscle.state.activation = 0.3;
      compute_system(muscle.tissue, limb.skeleton, load, muscle.state, muscle.system);
      const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> reference(muscle.system.matrix.lower());
      ASSERT_EQ(reference.info(), Eigen::Success);
      ASSERT_TRUE(muscle.system.factor.matrix.factor(muscle.system.matrix));
      const auto right =
          Eigen::MatrixXd::NullaryExpr(muscle.system.residual_N.size(), 8, [&] { return value(random); }).eval();
      const Eigen::MatrixXd expected = reference.solve(right);
      EXPECT_LT(relative_error(muscle.system.factor.matrix.solve(right), expected), 1e-2);
      EXPECT_LT(relative_error(muscle.system.factor.matrix.solve_refined(muscle.system.matrix, right), expected), 1e-4);
    }
  }
}

TEST(BlockMatrix, NamesTheSameBlockInBothOrders) {
  BlockMatrix matrix(3, std::vector<std::vector<int>>{{0, 2}});
  Mat3 block;
  block << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  matrix.add(0, 2, block);
  EXPECT_EQ(dense(matrix).block(0, 6, 3, 3), Eigen::MatrixXd(block));
  EXPECT_EQ(matrix.slot(2, 1).base, -1);
}

}  // namespace myotact::simulation
