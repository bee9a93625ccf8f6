#include "haptics/effects/vibration.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myotact::haptics {
namespace {

VibrationGrid two_by_two() {
  VibrationGrid grid;
  grid.order = 2;
  grid.force_N = {0.5, 2.0};
  grid.speed_m_s = {0.02, 0.1};
  for (const double k : {-0.9, -0.5, 0.2, 0.8}) {
    VibrationNode node;
    node.reflection[0] = k;
    node.reflection[1] = 0.9;
    node.rms_N = 0.01 + 0.05 * (k + 1.0);
    grid.nodes.push_back(node);
  }
  return grid;
}

TEST(Vibration, TakesNodesAsTheyAreAndMixesBetween) {
  const VibrationGrid grid = two_by_two();
  for (std::size_t f = 0; f < 2; ++f) {
    for (std::size_t s = 0; s < 2; ++s) {
      const VibrationNode at = vibration_at(grid, grid.force_N[f], grid.speed_m_s[s]);
      EXPECT_DOUBLE_EQ(at.rms_N, grid.node(f, s).rms_N);
      EXPECT_DOUBLE_EQ(at.reflection[0], grid.node(f, s).reflection[0]);
    }
  }
  const VibrationNode middle = vibration_at(grid, 1.25, 0.06);
  EXPECT_NEAR(middle.reflection[0], 0.25 * (-0.9 - 0.5 + 0.2 + 0.8), 1e-12);
  EXPECT_NEAR(middle.reflection[1], 0.9, 1e-12);
}

TEST(Vibration, FadesBelowTheFirstNodeAndStaysBeyondTheLast) {
  const VibrationGrid grid = two_by_two();
  EXPECT_EQ(vibration_at(grid, 0.0, 0.05).rms_N, 0.0);
  EXPECT_EQ(vibration_at(grid, 1.0, 0.0).rms_N, 0.0);
  EXPECT_NEAR(vibration_at(grid, 0.25, 0.02).rms_N, 0.5 * grid.node(0, 0).rms_N, 1e-12);
  EXPECT_EQ(vibration_at(grid, 50.0, 9.0).rms_N, grid.node(1, 1).rms_N);
  EXPECT_EQ(vibration_at({}, 1.0, 0.1).rms_N, 0.0);
}

TEST(Vibration, NoiseIsNormalEnoughAndTheSameForASeed) {
  Noise noise(1), same(1), other(2);
  double sum = 0.0, squares = 0.0, fourth = 0.0, neighbours = 0.0, last = 0.0;
  constexpr int kCount = 400'000;
  int alike = 0;
  for (int i = 0; i < kCount; ++i) {
    const double x = noise.next();
    ASSERT_EQ(x, same.next());
    alike += x == other.next() ? 1 : 0;
    ASSERT_LT(std::abs(x), 6.0);
    sum += x;
    squares += x * x;
    fourth += x * x * x * x;
    neighbours += x * last;
    last = x;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.01);  // five standard errors and more
  EXPECT_NEAR(squares / kCount, 1.0, 0.012);
  EXPECT_NEAR(fourth / kCount, 2.9, 0.08);  // 3 - 1.2 / 12 for a sum of twelve
  EXPECT_NEAR(neighbours / kCount, 0.0, 0.01);
  EXPECT_LT(alike, 10);
}

TEST(Vibration, IsAsStrongAsTheModelSays) {
  const VibrationGrid grid = two_by_two();
  Vibration vibration(4);
  for (const double speed_m_s : {0.02, 0.05, 0.1}) {
    double squares = 0.0;
    constexpr int kCount = 200'000;
    for (int i = 0; i < kCount; ++i) squares += std::pow(vibration.next_N(grid, 1.0, speed_m_s), 2);
    const double expected_N = vibration_at(grid, 1.0, speed_m_s).rms_N;
    EXPECT_NEAR(std::sqrt(squares / kCount), expected_N, 0.05 * expected_N) << speed_m_s;
  }
}

}  // namespace
}  // namespace myotact::haptics
