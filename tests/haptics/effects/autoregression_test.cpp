#include "haptics/effects/autoregression.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace myotact::haptics {
namespace {

constexpr double kRate_Hz = 1000.0;

TEST(Autoregression, StepsUpToThePredictionOfOrderTwo) {
  // y_n + k1 (1 + k2) y_{n-1} + k2 y_{n-2} = e_n
  const std::vector<double> a = prediction_coefficients(std::array{-0.6, 0.5});
  ASSERT_EQ(a.size(), 2u);
  EXPECT_DOUBLE_EQ(a[0], -0.6 * 1.5);
  EXPECT_DOUBLE_EQ(a[1], 0.5);
}

/// S(f) = 2 (1 - k^2) / (rate |1 + k e^{-j w}|^2), in closed form for order one.
TEST(Autoregression, DensityOfOrderOneIsTheClosedForm) {
  for (const double k : {-0.9, -0.3, 0.5}) {
    for (const double f : {0.0, 20.0, 133.0, 450.0}) {
      const double w = 2.0 * std::numbers::pi * f / kRate_Hz;
      const double expected = 2.0 * (1.0 - k * k) / (kRate_Hz * (1.0 + k * k + 2.0 * k * std::cos(w)));
      EXPECT_NEAR(spectral_density_1_Hz(std::array{k}, f, kRate_Hz), expected, 1e-12 * expected);
    }
  }
}

TEST(Autoregression, DensityHoldsThePowerOfUnitVariance) {
  const std::array reflection = {-0.85, 0.9, -0.3, 0.4};
  double power = 0.0;
  for (int i = 0; i < 5000; ++i) power += 0.1 * spectral_density_1_Hz(reflection, 0.1 * (i + 0.5), kRate_Hz);
  EXPECT_NEAR(power, 1.0, 1e-6);
  const double white = power_above({}, 300.0, kRate_Hz);
  EXPECT_NEAR(white, 0.4, 1e-3);  // white noise: 200 of 500 Hz
}

TEST(Lattice, IsTheRecursionOfItsPrediction) {
  const std::array reflection = {-0.85, 0.9, -0.3, 0.4};
  const std::vector<double> a = prediction_coefficients(reflection);
  double white = 1.0;
  for (const double k : reflection) white *= 1.0 - k * k;
  Lattice lattice;
  std::vector<double> y;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (int n = 0; n < 500; ++n) {
    const double input = normal(random);
    double expected = std::sqrt(white) * input;
    for (std::size_t i = 0; i < a.size() && i < y.size(); ++i) expected -= a[i] * y[y.size() - 1 - i];
    y.push_back(expected);
    ASSERT_NEAR(lattice.next(reflection, input), expected, 1e-10) << n;
  }
}

TEST(Lattice, NothingGrowsHoweverTheModelChanges) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> within(-0.999, 0.999);
  std::uniform_int_distribution<std::size_t> orders(0, VibrationNode::kMaxOrder);
  Lattice lattice;
  double given = 0.0, taken = 0.0;  // energy
  for (int n = 0; n < 20'000; ++n) {
    std::vector<double> reflection(orders(random));
    for (double& k : reflection) k = within(random);
    const double input = n < 100 ? 1.0 : 0.0;
    given += input * input;
    const double y = lattice.next(reflection, input);
    taken += y * y;
    ASSERT_LE(y * y, given + 1e-9);
    if (n > 10'000 && n % 100 == 0) taken = 0.0;  // of the last 100 samples
  }
  EXPECT_LT(taken, given);
}

}  // namespace
}  // namespace myotact::haptics
