#include "simulation/muscle/activation.h"

#include <gtest/gtest.h>

namespace myotact::simulation {
namespace {

double activation_after(double seconds, double start, double excitation, double dt_s) {
  double a = start;
  const int steps = static_cast<int>(seconds / dt_s + 0.5);
  for (int step = 0; step < steps; ++step) a = step_activation(a, excitation, {}, dt_s);
  return a;
}

// Thelen 2003 integrated with a fine step; time constants 15 and 50 ms.
TEST(Activation, RisesAndFallsAsPublishedAtAnyStep) {
  constexpr double kTolerance = 1e-3;
  for (const double dt_s : {1e-3, 1e-2}) {
    EXPECT_NEAR(activation_after(0.010, 0.01, 1.0, dt_s), 0.51388, kTolerance);
    EXPECT_NEAR(activation_after(0.030, 0.01, 1.0, dt_s), 0.79837, kTolerance);
    EXPECT_NEAR(activation_after(0.050, 0.01, 1.0, dt_s), 0.90439, kTolerance);
    EXPECT_NEAR(activation_after(0.050, 1.0, 0.01, dt_s), 0.28378, kTolerance);
    EXPECT_NEAR(activation_after(0.100, 1.0, 0.01, dt_s), 0.13383, kTolerance);
  }
}

TEST(Activation, TwoHalfStepsEqualOneStep) {
  const ActivationTimes times{0.02, 0.06};
  for (const double u : {0.0, 0.3, 1.0}) {
    const double half = step_activation(step_activation(0.4, u, times, 0.004), u, times, 0.004);
    EXPECT_NEAR(half, step_activation(0.4, u, times, 0.008), 1e-12) << u;
  }
}

TEST(Activation, StaysBetweenStartAndExcitationForHugeSteps) {
  for (const double dt_s : {0.0, 1e-9, 1.0, 1e6}) {
    const double up = step_activation(0.0, 0.7, {}, dt_s);
    const double down = step_activation(1.0, 0.2, {}, dt_s);
    EXPECT_TRUE(up >= 0.0 && up <= 0.7 + 1e-15) << dt_s;
    EXPECT_TRUE(down >= 0.2 - 1e-15 && down <= 1.0) << dt_s;
  }
  EXPECT_NEAR(step_activation(0.0, 0.7, {}, 1e6), 0.7, 1e-12);
}

TEST(Activation, ClampsItsArguments) {
  EXPECT_EQ(step_activation(-1.0, 2.0, {0.0, 0.0}, 0.01), 1.0);
  EXPECT_EQ(step_activation(3.0, -1.0, {0.0, 0.0}, 0.01), 0.0);
}

}  // namespace
}  // namespace myotact::simulation
