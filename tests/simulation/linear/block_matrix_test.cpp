#include "simulation/linear/block_matrix.h"

#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "simulation/linear/block_factor.h"

// Sparse matrices of random patterns and their factors against dense ones that are added up beside them.

namespace myotact::simulation {
namespace {

struct Coupled {
  int nodes = 0;
  std::vector<std::vector<int>> cliques;
  std::set<std::pair<int, int>> pairs;  // row >= column
};

/// Overlapping cliques of 1 to 10 nodes, some of them named twice or absent (-1); nodes that none names stand alone.
Coupled random_coupling(int nodes, int cliques, std::mt19937& random) {
  std::uniform_int_distribution<int> any(-1, nodes - 1), size(1, 10);
  Coupled coupled{nodes, {}, {}};
  for (int n = 0; n < nodes; ++n) coupled.pairs.emplace(n, n);
  for (int k = 0; k < cliques; ++k) {
    std::vector<int>& clique = coupled.cliques.emplace_back(static_cast<std::size_t>(size(random)));
    for (int& node : clique) node = any(random);
    for (const int a : clique) {
      for (const int b : clique) {
        if (a >= b && b >= 0) coupled.pairs.emplace(a, b);
      }
    }
  }
  return coupled;
}

struct Twins {
  BlockMatrix sparse;
  Eigen::MatrixXd dense;
};

/// Blocks of about unit size at every pair, named in either order and in two parts; `diagonal` on each node.
Twins filled(const Coupled& coupled, const Eigen::VectorXd& diagonal, std::mt19937& random) {
  std::normal_distribution<double> normal;
  Twins twins{BlockMatrix(coupled.nodes, coupled.cliques), {}};
  twins.dense = Eigen::MatrixXd::Zero(3 * coupled.nodes, 3 * coupled.nodes);
  for (const auto& [row, column] : coupled.pairs) {
    for (int part = 0; part < 2; ++part) {
      Mat3 block = Mat3::NullaryExpr([&] { return normal(random); });
      if (row == column) block = (block + block.transpose()).eval();
      const bool turned = random() % 2 == 0;
      turned ? twins.sparse.add(column, row, block.transpose()) : twins.sparse.add(row, column, block);
      twins.dense.block<3, 3>(3 * row, 3 * column) += block;
      if (row != column) twins.dense.block<3, 3>(3 * column, 3 * row) += block.transpose();
    }
  }
  for (int node = 0; node < coupled.nodes; ++node) {
    twins.sparse.add_diagonal(node, diagonal[node]);
    twins.dense.diagonal().segment<3>(3 * node).array() += diagonal[node];
  }
  return twins;
}

/// Larger than all that the blocks of a row add up to: definite for certain where positive.
Eigen::VectorXd dominant_diagonal(const Coupled& coupled) {
  Eigen::VectorXd neighbours = Eigen::VectorXd::Zero(coupled.nodes);
  for (const auto& [row, column] : coupled.pairs) neighbours[row] += 1.0, neighbours[column] += 1.0;
  return 12.0 * neighbours;
}

Eigen::MatrixXd whole(const BlockMatrix& matrix) {
  return Eigen::MatrixXd(matrix.lower()).selfadjointView<Eigen::Lower>();
}

TEST(BlockMatrix, HoldsTheSumsOfItsBlocksWhateverTheirOrder) {
  std::mt19937 random(31);
  for (int round = 0; round < 60; ++round) {
    const int nodes = std::uniform_int_distribution<int>(1, 30)(random);
    const Coupled coupled = random_coupling(nodes, 12, random);
    const Twins twins = filled(coupled, dominant_diagonal(coupled), random);
    EXPECT_LT((whole(twins.sparse) - twins.dense).cwiseAbs().maxCoeff(), 1e-12 * twins.dense.maxCoeff());
  }
}

TEST(BlockMatrix, StoresTheCoupledPairsAndNoOthers) {
  std::mt19937 random(32);
  for (int round = 0; round < 60; ++round) {
    const int nodes = std::uniform_int_distribution<int>(1, 30)(random);
    const Coupled coupled = random_coupling(nodes, 6, random);
    BlockMatrix matrix(nodes, coupled.cliques);
    EXPECT_EQ(matrix.nodes(), nodes);
    EXPECT_EQ(matrix.lower().nonZeros(), static_cast<Eigen::Index>(9 * coupled.pairs.size()));
    for (int row = 0; row < nodes; ++row) {
      for (int column = 0; column <= row; ++column) {
        const BlockSlot slot = matrix.slot(row, column);
        ASSERT_EQ(slot.base >= 0, coupled.pairs.contains({row, column})) << row << " " << column;
        if (slot.base < 0) continue;
        matrix.values()[slot.base + 2 * slot.stride + 1] = 1000.0 * row + column;  // entry (1, 2) of the block
        ASSERT_EQ(matrix.lower().coeff(3 * row + 1, 3 * column + 2), 1000.0 * row + column);
      }
    }
    matrix.set_zero();
    EXPECT_EQ(matrix.lower().norm(), 0.0);
    EXPECT_EQ(matrix.lower().nonZeros(), static_cast<Eigen::Index>(9 * coupled.pairs.size()));
  }
}

/// Rounding of the factors times a condition number below 100.
template <class Scalar>
constexpr double kSolveRounding = 1e3 * std::numeric_limits<Scalar>::epsilon();

template <class Scalar>
class BlockFactorOfAny : public ::testing::Test {};
using FactorScalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(BlockFactorOfAny, FactorScalars);

/// From nodes that are not coupled at all to a matrix that is full; one to nine right sides.
TYPED_TEST(BlockFactorOfAny, SolvesAnyPatternAsEigenDoes) {
  std::mt19937 random(33);
  for (int round = 0; round < 60; ++round) {
    const int nodes = std::uniform_int_distribution<int>(1, 50)(random);
    const Coupled coupled = random_coupling(nodes, round % 5 == 0 ? 0 : round, random);
    Eigen::VectorXd diagonal = dominant_diagonal(coupled);
    const bool mixed = round % 2 == 1;
    for (int node = 0; mixed && node < nodes; ++node) diagonal[node] *= random() % 2 == 0 ? 1.0 : -1.0;
    const bool positive = (diagonal.array() > 0.0).all();
    const Twins twins = filled(coupled, diagonal, random);
    BlockFactorOf<TypeParam> factor(twins.sparse);
    ASSERT_TRUE(factor.factor(twins.sparse));
    EXPECT_EQ(factor.positive(), positive);
    const Eigen::MatrixXd wanted = Eigen::MatrixXd::Random(3 * nodes, 1 + round % 9);
    const Eigen::MatrixXd right = twins.dense * wanted;
    EXPECT_LT((factor.solve(right) - wanted).norm(), kSolveRounding<TypeParam> * wanted.norm()) << nodes;
    EXPECT_LT((factor.solve_refined(twins.sparse, right) - wanted).norm(), 1e-11 * wanted.norm()) << nodes;
  }
}

TYPED_TEST(BlockFactorOfAny, AddingUpWhereItIsFactoredGivesTheSameBits) {
  std::mt19937 random(34);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 20; ++round) {
    const Coupled coupled = random_coupling(40, 15, random);
    BlockMatrix matrix(40, coupled.cliques);
    BlockFactorOf<TypeParam> copied(matrix), added(matrix);
    added.set_zero();
    for (const auto& [row, column] : coupled.pairs) {
      Mat3 block = Mat3::NullaryExpr([&] { return normal(random); });
      if (row == column) block = (block + block.transpose() + 300.0 * Mat3::Identity()).eval();
      matrix.add(row, column, block);
      random() % 2 == 0 ? added.add(row, column, block) : added.add(column, row, block.transpose());
    }
    ASSERT_TRUE(copied.factor(matrix));
    ASSERT_TRUE(added.factor());
    const Eigen::MatrixXd right = Eigen::MatrixXd::Random(120, 3);
    EXPECT_EQ(copied.solve(right), added.solve(right));
  }
}

/// A step that failed leaves nothing behind: neither in the factor nor in the workspace of its thread.
TYPED_TEST(BlockFactorOfAny, ANumberThatIsNoneIsForgottenByTheNextFactor) {
  std::mt19937 random(35);
  const Coupled coupled = random_coupling(40, 15, random), other = random_coupling(25, 20, random);
  const Twins sound = filled(coupled, dominant_diagonal(coupled), random);
  const Twins beside = filled(other, dominant_diagonal(other), random);
  BlockFactorOf<TypeParam> factor(sound.sparse), another(beside.sparse);
  const Eigen::MatrixXd right = Eigen::MatrixXd::Random(120, 2), short_right = Eigen::MatrixXd::Random(75, 2);
  ASSERT_TRUE(factor.factor(sound.sparse));
  ASSERT_TRUE(another.factor(beside.sparse));
  const Eigen::MatrixXd expected = factor.solve(right), other_expected = another.solve(short_right);
  for (const auto& [row, column] : coupled.pairs) {
    BlockMatrix spoilt = sound.sparse;
    Mat3 block = Mat3::Zero();
    block(2, row == column ? 2 : 0) = std::nan("");
    spoilt.add(row, column, block);
    ASSERT_FALSE(factor.factor(spoilt)) << row << " " << column;
    ASSERT_FALSE(factor.positive());
    ASSERT_TRUE(another.factor(beside.sparse));
    ASSERT_EQ(another.solve(short_right), other_expected);
    ASSERT_TRUE(factor.factor(sound.sparse));
    ASSERT_EQ(factor.solve(right), expected);
  }
}

}  // namespace
}  // namespace myotact::simulation
