#include "simulation/linear/dense_front.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/dense_matrix.h"
#include "simulation/simd/batch.h"

// The dense kernels under every factor, on each kind of vector register that this processor has, against Eigen.

namespace myotact::simulation {
namespace {

/// Puts the widest unit back at the end of a test.
class UnitGuard {
 public:
  ~UnitGuard() { allow_vector_unit(VectorUnit::Avx512); }
};

constexpr std::array kAllUnits{VectorUnit::Sse2, VectorUnit::Avx2, VectorUnit::Avx512};

/// A front with the memory that it needs, from the lower triangle of a matrix.
template <class Scalar>
struct OwnedFront {
  std::vector<Scalar> own_places, rest_places, work;
  DenseFront<Scalar> front;

  OwnedFront(int size, int own)
      : own_places(places(own, size)), rest_places(places(size - own, size - own)), work(places(kFrontPanel, size)) {
    front = {own_places.data(), rest_places.data(), size, own};
  }
  explicit OwnedFront(const Eigen::MatrixXd& matrix, int own) : OwnedFront(static_cast<int>(matrix.rows()), own) {
    for (int c = 0; c < front.size; ++c) {
      for (int r = c; r < front.size; ++r) front.column(c)[r] = static_cast<Scalar>(matrix(r, c));
    }
  }
  /// Rows and columns [first, end), the lower triangle alone.
  Eigen::MatrixXd lower(int first, int end) const {
    Eigen::MatrixXd part = Eigen::MatrixXd::Zero(end - first, end - first);
    for (int c = first; c < end; ++c) {
      for (int r = c; r < end; ++r) part(r - first, c - first) = static_cast<double>(front.column(c)[r]);
    }
    return part;
  }

 private:
  static std::size_t places(int columns, int rows) {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows + kFrontPadding) + kFrontPadding;
  }
};

/// Symmetric, its eigenvalues 1 .. 3 in size; `negative` of them below zero.
Eigen::MatrixXd well_conditioned(int size, int negative, std::mt19937& random) {
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd any = Eigen::MatrixXd::NullaryExpr(size, size, [&] { return normal(random); });
  const Eigen::MatrixXd turn = symmetric_eigen(any + any.transpose()).vectors;
  Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(size, 1.0, 3.0);
  values.head(negative) *= -1.0;
  return turn * values.asDiagonal() * turn.transpose();
}

int multiple_of_three(int least, int most, std::mt19937& random) {
  return 3 * std::uniform_int_distribution<int>(least / 3, most / 3)(random);
}

/// Rounding of a Scalar times what a front of 120 rows gathers of it.
template <class Scalar>
constexpr double kFrontRounding = 200.0 * std::numeric_limits<Scalar>::epsilon();

template <class Scalar>
class DenseFrontOf : public ::testing::Test {};
using FrontScalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(DenseFrontOf, FrontScalars);

TYPED_TEST(DenseFrontOf, EliminatingLeavesTheSchurComplementAndAProductThatIsTheMatrix) {
  const UnitGuard guard;
  for (const VectorUnit unit : kAllUnits) {
    allow_vector_unit(unit);
    std::mt19937 random(17);
    for (int round = 0; round < 25; ++round) {
      const int size = multiple_of_three(3, 120, random), own = multiple_of_three(3, size, random);
      const Eigen::MatrixXd matrix = well_conditioned(size, 0, random);
      OwnedFront<TypeParam> owned(matrix, own);
      ASSERT_EQ(eliminate_front(owned.front, owned.work.data()), Pivots::Positive) << size << " " << own;
      Eigen::MatrixXd L = owned.lower(0, size).leftCols(own);
      const Eigen::VectorXd D = L.diagonal();
      L.diagonal().setOnes();
      Eigen::MatrixXd product = L * D.asDiagonal() * L.transpose();
      const Eigen::MatrixXd rest = owned.lower(own, size).template selfadjointView<Eigen::Lower>();
      product.bottomRightCorner(size - own, size - own) += rest;
      EXPECT_LT((product - matrix).norm(), kFrontRounding<TypeParam> * matrix.norm()) << size << " " << own;
      const Eigen::MatrixXd below = matrix.bottomLeftCorner(size - own, own);
      const Eigen::MatrixXd schur = matrix.bottomRightCorner(size - own, size - own) -
                                    below * solve_dense(matrix.topLeftCorner(own, own), below.transpose());
      EXPECT_LT((rest - schur).norm(), kFrontRounding<TypeParam> * matrix.norm()) << size << " " << own;
    }
  }
}

constexpr int kSides = static_cast<int>(kRightSides);

TYPED_TEST(DenseFrontOf, OneSideAloneGivesTheSameBitsAsBesideOthers) {
  std::mt19937 random(17);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 25; ++round) {
    const int size = multiple_of_three(6, 120, random), own = multiple_of_three(3, size, random);
    OwnedFront<TypeParam> owned(well_conditioned(size, 0, random), own);
    ASSERT_EQ(eliminate_front(owned.front, owned.work.data()), Pivots::Positive);
    const std::size_t stride = static_cast<std::size_t>(size) + kFrontPadding;
    std::vector<TypeParam> four(kRightSides * stride + kFrontPadding, TypeParam(0));
    for (std::size_t k = 0; k < kRightSides * stride; ++k) {
      if (k % stride < static_cast<std::size_t>(size)) four[k] = static_cast<TypeParam>(normal(random));
    }
    std::vector<TypeParam> one(four.begin() + static_cast<std::ptrdiff_t>(stride),
                               four.begin() + static_cast<std::ptrdiff_t>(2 * stride + kFrontPadding));
    std::fill(one.begin() + size, one.end(), TypeParam(0));
    solve_forward<kRightSides>(owned.front, four.data());
    solve_backward<kRightSides>(owned.front, four.data());
    solve_forward<1>(owned.front, one.data());
    solve_backward<1>(owned.front, one.data());
    for (std::size_t k = 0; k < static_cast<std::size_t>(size); ++k) ASSERT_EQ(one[k], four[stride + k]) << size;
  }
}

TYPED_TEST(DenseFrontOf, SolvingForthAndBackIsTheInverseOfTheWholeMatrix) {
  const UnitGuard guard;
  for (const VectorUnit unit : kAllUnits) {
    allow_vector_unit(unit);
    std::mt19937 random(18);
    std::normal_distribution<double> normal;
    for (int round = 0; round < 25; ++round) {
      const int size = multiple_of_three(6, 120, random), own = multiple_of_three(3, size, random);
      const Eigen::MatrixXd matrix = well_conditioned(size, 0, random);
      const Eigen::MatrixXd right = Eigen::MatrixXd::NullaryExpr(size, kSides, [&] { return normal(random); });
      OwnedFront<TypeParam> owned(matrix, own);
      ASSERT_EQ(eliminate_front(owned.front, owned.work.data()), Pivots::Positive);
      const int stride = size + kFrontPadding;
      std::vector<TypeParam> x(kRightSides * static_cast<std::size_t>(stride) + kFrontPadding, TypeParam(0));
      const auto at = [&](int row, int side) -> TypeParam& { return x[static_cast<std::size_t>(side * stride + row)]; };
      for (int side = 0; side < kSides; ++side) {
        for (int row = 0; row < size; ++row) at(row, side) = static_cast<TypeParam>(right(row, side));
      }
      solve_forward<kRightSides>(owned.front, x.data());
      // What stays is solved by Eigen, as the fronts above would.
      const Eigen::MatrixXd rest = owned.lower(own, size).template selfadjointView<Eigen::Lower>();
      for (int side = 0; side < kSides && own < size; ++side) {
        Eigen::VectorXd below(size - own);
        for (int row = own; row < size; ++row) below[row - own] = static_cast<double>(at(row, side));
        below = solve_dense(rest, below);
        for (int row = own; row < size; ++row) at(row, side) = static_cast<TypeParam>(below[row - own]);
      }
      solve_backward<kRightSides>(owned.front, x.data());
      const Eigen::MatrixXd expected = solve_dense(matrix, right);
      for (int side = 0; side < kSides; ++side) {
        for (int row = 0; row < size; ++row) {
          ASSERT_NEAR(static_cast<double>(at(row, side)), expected(row, side),
                      kFrontRounding<TypeParam> * expected.norm());
        }
      }
    }
  }
}

/// Sylvester: as many negative pivots as negative eigenvalues; one is enough to be told.
TYPED_TEST(DenseFrontOf, AnyNegativeEigenvalueIsTold) {
  std::mt19937 random(19);
  for (int round = 0; round < 40; ++round) {
    const int size = multiple_of_three(3, 90, random);
    const int negative = std::uniform_int_distribution<int>(1, size)(random);
    OwnedFront<TypeParam> owned(well_conditioned(size, negative, random), size);
    ASSERT_EQ(eliminate_front(owned.front, owned.work.data()), Pivots::Mixed) << size << " " << negative;
    const Eigen::VectorXd pivots = owned.lower(0, size).diagonal();
    EXPECT_EQ((pivots.array() < 0.0).count(), negative) << size;
  }
}

TYPED_TEST(DenseFrontOf, AZeroOrANumberThatIsNoneInAnyColumnIsUnusable) {
  const UnitGuard guard;
  constexpr auto kInfinity = std::numeric_limits<double>::infinity();
  for (const VectorUnit unit : kAllUnits) {
    allow_vector_unit(unit);
    std::mt19937 random(20);
    const Eigen::MatrixXd sound = well_conditioned(60, 0, random);
    for (int column = 0; column < 60; ++column) {
      for (const double spoilt : {0.0, std::nan(""), kInfinity, -kInfinity}) {
        Eigen::MatrixXd matrix = sound;
        if (spoilt == 0.0) matrix.row(column).setZero(), matrix.col(column).setZero();
        matrix(column, column) = spoilt;
        OwnedFront<TypeParam> owned(matrix, 60);
        EXPECT_EQ(eliminate_front(owned.front, owned.work.data()), Pivots::Unusable) << column << " " << spoilt;
      }
    }
    // A column that is not eliminated here is not looked at.
    Eigen::MatrixXd later = sound;
    later(50, 50) = 0.0;
    OwnedFront<TypeParam> owned(later, 48);
    EXPECT_EQ(eliminate_front(owned.front, owned.work.data()), Pivots::Positive);
  }
}

/// Neighbouring rows of a child's remainder, in order, at random places of the parent.
std::vector<FrontRun> scattered_runs(int below, int size, std::mt19937& random) {
  std::vector<int> nodes(static_cast<std::size_t>(size / 3)), chosen;
  for (std::size_t n = 0; n < nodes.size(); ++n) nodes[n] = static_cast<int>(n);
  std::sample(nodes.begin(), nodes.end(), std::back_inserter(chosen), below / 3, random);
  std::vector<FrontRun> runs;
  for (const int node : chosen) {
    const bool goes_on = !runs.empty() && runs.back().place + runs.back().count == 3 * node;
    if (!goes_on) runs.push_back({0, 3 * node});
    runs.back().count += 3;
  }
  return runs;
}

TYPED_TEST(DenseFrontOf, ARemainderIsAddedWhereItsRunsSayAndNowhereElse) {
  const UnitGuard guard;
  for (const VectorUnit unit : kAllUnits) {
    allow_vector_unit(unit);
    std::mt19937 random(21);
    for (int round = 0; round < 40; ++round) {
      const int size = multiple_of_three(6, 90, random), own = multiple_of_three(3, size, random);
      const int below = multiple_of_three(3, size, random);
      const Eigen::MatrixXd parent = well_conditioned(size, 0, random), child = well_conditioned(below, 0, random);
      const std::vector<FrontRun> runs = scattered_runs(below, size, random);
      Eigen::MatrixXd expected = parent;
      std::vector<int> rows;
      for (const FrontRun& run : runs) {
        for (int k = 0; k < run.count; ++k) rows.push_back(run.place + k);
      }
      for (int r = 0; r < below; ++r) {
        for (int c = 0; c < below; ++c) {
          expected(rows[static_cast<std::size_t>(r)], rows[static_cast<std::size_t>(c)]) += child(r, c);
        }
      }
      OwnedFront<TypeParam> to(parent, own);
      OwnedFront<TypeParam> from(child, 0);
      // What lies behind a column's end may be anything, and must stay out.
      for (int c = 0; c < below; ++c) from.front.column(c)[below] = std::numeric_limits<TypeParam>::quiet_NaN();
      add_remainder<TypeParam>(from.rest_places.data(), runs, to.front);
      const Eigen::MatrixXd gap = to.lower(0, size) - Eigen::MatrixXd(expected.triangularView<Eigen::Lower>());
      ASSERT_LT(gap.cwiseAbs().maxCoeff(), 4.0 * std::numeric_limits<TypeParam>::epsilon() * 6.0);
    }
  }
}

}  // namespace
}  // namespace myotact::simulation
