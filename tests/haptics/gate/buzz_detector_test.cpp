#include "haptics/gate/buzz_detector.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace myotact::haptics {
namespace {

constexpr double kTick_s = 1e-3;

/// Smallest share while the device swings by +-`amplitude_m` at `frequency_hz` for a second.
double share_after(double frequency_hz, double amplitude_m, bool feels = true) {
  BuzzDetector detector(20e-6);
  for (int i = 0; i < 1000; ++i) {
    const double x_m = amplitude_m * std::sin(2.0 * std::numbers::pi * frequency_hz * i * kTick_s);
    detector.tick(Vec3(0.0, 0.6 * x_m, 0.8 * x_m), feels, kTick_s);
  }
  return detector.stiffness_share();
}

TEST(BuzzDetector, HalvesTheStiffnessWhileTheToolBuzzes) {
  for (const double frequency_hz : {20.0, 40.0, 100.0}) EXPECT_LT(share_after(frequency_hz, 0.5e-3), 0.55);
}

TEST(BuzzDetector, NeitherTremorNorTextureNorAFreeToolIsABuzz) {
  EXPECT_EQ(share_after(12.0, 0.5e-3), 1.0);         // the fastest tremor, 24 turns a second
  EXPECT_EQ(share_after(60.0, 0.07e-3), 1.0);        // texture moves a hand by less
  EXPECT_EQ(share_after(40.0, 0.5e-3, false), 1.0);  // nothing is touched
  EXPECT_EQ(share_after(1.0, 20e-3), 1.0);
}

TEST(BuzzDetector, WhatRingsOutAfterAKnockIsNoBuzz) {
  BuzzDetector detector(20e-6);
  for (int i = 0; i < 1000; ++i) {
    const double t_s = i * kTick_s;
    const double x_m = 3e-3 * std::exp(-5.0 * t_s) * std::sin(2.0 * std::numbers::pi * 30.0 * t_s);
    EXPECT_FALSE(detector.tick(Vec3(0.0, 0.0, x_m), true, kTick_s));
  }
}

TEST(BuzzDetector, ABouncingToolTouchesOnlyNowAndThen) {
  BuzzDetector detector(20e-6);
  bool halved = false;
  for (int i = 0; i < 1000; ++i) {
    const double x_m = 0.5e-3 * std::sin(2.0 * std::numbers::pi * 30.0 * i * kTick_s);
    halved = detector.tick(Vec3(x_m, 0, 0), x_m < 0.0, kTick_s) || halved;
  }
  EXPECT_TRUE(halved);
}

TEST(BuzzDetector, AnEighthIsTheSoftestAndItDoublesInTenSeconds) {
  BuzzDetector detector(20e-6);
  for (int i = 0; i < 20'000; ++i) detector.tick(Vec3((i / 10) % 2 * 1e-3, 0, 0), true, kTick_s);  // 50 Hz for 20 s
  EXPECT_GE(detector.stiffness_share(), 0.125);
  EXPECT_LT(detector.stiffness_share(), 0.14);
  for (int i = 0; i < 200; ++i) detector.tick(Vec3::Zero(), true, kTick_s);  // the last swing is over
  const double share = detector.stiffness_share();
  for (int i = 0; i < 10'000; ++i) detector.tick(Vec3::Zero(), true, kTick_s);
  EXPECT_NEAR(detector.stiffness_share(), 2.0 * share, 1e-6);
  for (int i = 0; i < 40'000; ++i) detector.tick(Vec3::Zero(), true, kTick_s);
  EXPECT_EQ(detector.stiffness_share(), 1.0);
}

TEST(BuzzDetector, ACoarseEncoderAtRestIsNoBuzz) {
  BuzzDetector detector(55e-6);
  for (int i = 0; i < 5000; ++i) detector.tick(Vec3((i / 5) % 3 * 55e-6, 0, 0), true, kTick_s);
  EXPECT_EQ(detector.stiffness_share(), 1.0);
}

}  // namespace
}  // namespace myotact::haptics
