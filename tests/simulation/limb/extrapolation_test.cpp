#include "simulation/limb/extrapolation.h"

#include <gtest/gtest.h>

namespace myotact::simulation {
namespace {

/// A map with the fixed point (1, 2, 3) that creeps along one axis, swings along another and leads away along the
/// third.
Eigen::VectorXd creep_and_swing(const Eigen::VectorXd& x) {
  const Eigen::Vector3d goal(1.0, 2.0, 3.0), factors(0.95, -0.9, 1.2);
  return goal + factors.cwiseProduct(x - goal);
}

}  // namespace

TEST(Extrapolation, FindsTheFixedPointOfALinearMapInAStepMoreThanItHasFactors) {
  Extrapolation extrapolation;
  Eigen::VectorXd x = Eigen::Vector3d(-4.0, 7.0, 3.5);
  for (int step = 0; step < 4; ++step) x = extrapolation.next(x, creep_and_swing(x));
  EXPECT_LT((x - Eigen::Vector3d(1.0, 2.0, 3.0)).norm(), 1e-9);
}

TEST(Extrapolation, FirstStepAndOneAfterForgettingAreTaken) {
  Extrapolation extrapolation;
  const Eigen::VectorXd from = Eigen::Vector2d(0.0, 1.0), to = Eigen::Vector2d(2.0, 3.0);
  EXPECT_EQ(extrapolation.next(from, to), to);
  extrapolation.next(to, from);
  extrapolation.forget();
  EXPECT_EQ(extrapolation.next(from, to), to);
}

TEST(Extrapolation, StandsWhereNothingMoves) {
  Extrapolation extrapolation;
  const Eigen::VectorXd here = Eigen::Vector2d(0.5, -1.0);
  for (int step = 0; step < 10; ++step) EXPECT_EQ(extrapolation.next(here, here), here);
}

}  // namespace myotact::simulation
