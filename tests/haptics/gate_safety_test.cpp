// What the gate does when device, motors or clock misbehave.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "haptics/faults.h"
#include "haptics/gate/motor_heat.h"
#include "haptics/gate_rig.h"

namespace myotact::haptics {
namespace {

bool raised(const Rig& rig, Fault fault) {
  return (rig.gate.faults() & bit(fault)) != 0;
}

TEST(GateSafety, HalfOfThePeakIsTheMostUnlessAskedForMore) {
  GateSettings settings;
  Rig rig(settings);
  rig.open();
  Vec3 sent_N = Vec3::Zero();
  for (int i = 0; i < 50; ++i) sent_N = rig.tick(Vec3(0, 30, 40));
  EXPECT_NEAR((sent_N - 0.5 * kPeak_N * Vec3(0, 0.6, 0.8)).norm(), 0.0, 1e-9);
  for (const double share : {0.0, 0.2, 1.0, 7.0}) {  // more than all of it is all of it
    settings.force_limit = share;
    Rig other(settings);
    other.open();
    for (int i = 0; i < 50; ++i) sent_N = other.tick(Vec3(0, 30, 40));
    EXPECT_NEAR(sent_N.norm(), std::min(share, 1.0) * kPeak_N, 1e-9) << share;
  }
}

TEST(GateSafety, AStopStaysUntilForcesAreEnabledAgain) {
  Rig rig;
  rig.open();
  rig.tick(Vec3(0.2, 0, 0));
  rig.gate.stop();
  for (int i = 0; i < 3000; ++i) {
    EXPECT_EQ(rig.tick(Vec3(0.1, 0, 0)).norm(), 0.0);
    EXPECT_TRUE(raised(rig, Fault::Stopped));
  }
  rig.gate.enable();
  rig.open();
  EXPECT_FALSE(raised(rig, Fault::Stopped));
}

TEST(GateSafety, AYankAtThreeMetresASecondCutsTheForceWithinTheTick) {
  Rig rig;
  rig.open();
  for (int i = 0; i < 20; ++i) rig.tick(Vec3(1, 0, 0));
  Vec3 position_m = Vec3::Zero();
  for (int i = 0; i < 50; ++i) {
    position_m.y() += 3e-3;
    EXPECT_EQ(rig.tick(Vec3(1, 0, 0), position_m).norm(), 0.0);
    EXPECT_TRUE(raised(rig, Fault::TooFast));
  }
  EXPECT_EQ(rig.gate.state(), GateState::Ramp);
  for (int i = 1; i <= 500; ++i) EXPECT_LE(rig.tick(Vec3(1, 0, 0), position_m).norm(), 1e-3 * (i + 1));
}

TEST(GateSafety, BelowTheCutOffNothingIsCut) {
  Rig rig;
  rig.open();
  Vec3 position_m = Vec3::Zero();
  for (int i = 0; i < 50; ++i) {
    position_m.y() += 0.99e-3;
    rig.tick(Vec3(0.5, 0, 0), position_m);
    EXPECT_FALSE(raised(rig, Fault::TooFast));
  }
  EXPECT_EQ(rig.gate.state(), GateState::On);
}

TEST(GateSafety, TheCutOffIsTheHandsOwnSpeedWhateverItsScale) {
  for (const double scale : {0.05, 0.1, 4.0, 20.0}) {
    device::DeviceProfile placed = cool_motors();
    placed.motion_scale = scale;
    Rig rig(full_share(), placed);
    rig.open();
    Vec3 position_m = Vec3::Zero();
    for (int i = 0; i < 20; ++i) {
      position_m.y() += scale * 0.9e-3;
      rig.tick(Vec3(0.1, 0, 0), position_m);
      EXPECT_FALSE(raised(rig, Fault::TooFast)) << scale;
    }
    position_m.y() += scale * 5e-3;
    EXPECT_EQ(rig.tick(Vec3(0.1, 0, 0), position_m).norm(), 0.0) << scale;
    EXPECT_TRUE(raised(rig, Fault::TooFast)) << scale;
    position_m.y() += scale * 25e-3;
    rig.tick(Vec3(0.1, 0, 0), position_m);
    EXPECT_TRUE(raised(rig, Fault::DeviceJumped)) << scale;
  }
}

TEST(GateSafety, AMouseMayBeAsFastAsItLikes) {
  device::DeviceProfile mouse = cool_motors();
  mouse.shows_force_only = true;
  Rig rig(full_share(), mouse);
  rig.open();
  Vec3 position_m = Vec3::Zero();
  for (int i = 0; i < 50; ++i) {
    position_m.y() += i == 25 ? 0.3 : 3e-3;  // a flick of the wrist, and a pointer that is set somewhere else
    rig.tick(Vec3(0.5, 0, 0), position_m);
    EXPECT_FALSE(raised(rig, Fault::TooFast) || raised(rig, Fault::DeviceJumped));
  }
  EXPECT_EQ(rig.gate.state(), GateState::On);
}

TEST(GateSafety, ALateTickIsJudgedByItsOwnTime) {
  Rig rig;
  rig.open();
  rig.now_ns += 29 * kTick_ns;  // 30 ms pass, the device goes 15 mm: 0.5 m/s
  rig.input.model_arrived_ns = rig.now_ns;
  rig.tick(Vec3(0.1, 0, 0), Vec3(0.015, 0, 0));
  EXPECT_FALSE(raised(rig, Fault::TooFast));
}

TEST(GateSafety, APlaceThatNoHandCanReachInATickIsAFaultOfTheDevice) {
  for (const double jump_m : {0.05, 1e3, 1e200, std::numeric_limits<double>::max()}) {
    Rig rig;
    rig.open();
    for (int i = 0; i < 20; ++i) rig.tick(Vec3(1, 0, 0));
    EXPECT_EQ(rig.tick(Vec3(1, 0, 0), Vec3(jump_m, 0, 0)).norm(), 0.0);
    EXPECT_TRUE(raised(rig, Fault::DeviceJumped)) << jump_m;
    EXPECT_EQ(rig.gate.state(), GateState::Armed);
    // It stays shut while a force is wanted, and opens through the ramp.
    for (int i = 0; i < 100; ++i) EXPECT_EQ(rig.tick(Vec3(1, 0, 0), Vec3(jump_m, 0, 0)).norm(), 0.0);
    rig.tick(Vec3::Zero(), Vec3(jump_m, 0, 0));
    EXPECT_EQ(rig.gate.state(), GateState::Ramp);
  }
}

TEST(GateSafety, AfterALossTheDeviceMayBeElsewhere) {
  Rig rig;
  rig.open();
  rig.input.connected = false;
  rig.tick(Vec3::Zero());
  rig.input.connected = true;
  rig.tick(Vec3::Zero(), Vec3(0.3, 0, 0));
  EXPECT_FALSE(raised(rig, Fault::DeviceJumped));
}

TEST(GateSafety, AClockThatRunsBackwardsNeitherOpensNorKicks) {
  Rig rig;
  rig.open();
  for (int i = 0; i < 20; ++i) rig.tick(Vec3(1, 0, 0));
  rig.publishes = false;
  rig.now_ns -= 900'000'000;
  EXPECT_NEAR(rig.tick(Vec3(1, 0, 0)).norm(), 1.0, 1e-12);
  EXPECT_TRUE(raised(rig, Fault::ClockBackwards));
  // The last model came "in the future" by now; it still grows old, and the force is gone 100 ms after it.
  double sent_N = 1.0;
  for (int i = 0; i < 101; ++i) sent_N = rig.tick(Vec3(1, 0, 0)).norm();
  EXPECT_EQ(sent_N, 0.0);
  EXPECT_TRUE(raised(rig, Fault::StaleModel));
}

TEST(GateSafety, AClockThatStandsStillLetsTheModelGrowOldToo) {
  Rig rig;
  rig.open();
  rig.publishes = false;
  rig.input.model_arrived_ns = rig.now_ns;
  double sent_N = 1.0;
  for (int i = 0; i < 120; ++i) {
    rig.now_ns -= kTick_ns;  // tick() adds it again
    sent_N = rig.tick(Vec3(1, 0, 0)).norm();
  }
  EXPECT_EQ(sent_N, 0.0);
}

// ---- heat of the motors

// Under a constant force the heat is (F/c)^2 (1 - exp(-t/20 s)).
TEST(MotorHeat, WarmsAndCoolsWithOneTimeConstant) {
  MotorHeat heat(1.0, 2.0);
  for (int i = 0; i < 3000; ++i) heat.book(1.4, 1e-3);
  EXPECT_NEAR(heat.heat(), 1.4 * 1.4 * (1.0 - std::exp(-3.0 / 20.0)), 1e-9);
  EXPECT_EQ(heat.limit_N(), 2.0);
  const double warm = heat.heat();
  for (int i = 0; i < 20; ++i) heat.book(0.0, 1.0);
  EXPECT_NEAR(heat.heat(), warm * std::exp(-1.0), 1e-12);
}

TEST(MotorHeat, WhateverIsWantedTheMeanSquareStaysWithinTheRating) {
  device::DeviceProfile profile;
  Rig rig(full_share(), profile);  // 3.3 N for a moment, 0.88 N for ever
  rig.open();
  double heat = 0.0, steepest_N = 0.0, last_N = 0.0;  // judged by a mean of its own, over the gate's 20 s
  for (int i = 0; i < 120'000; ++i) {
    const double sent_N = rig.tick(Vec3(0, 0, 10)).norm();
    heat += 1e-3 / 20.0 * (std::pow(sent_N / profile.continuous_force_N, 2) - heat);
    ASSERT_LE(heat, 1.001);
    steepest_N = std::max(steepest_N, last_N - sent_N);
    last_N = sent_N;
  }
  EXPECT_NEAR(last_N, profile.continuous_force_N, 0.01);
  EXPECT_LT(steepest_N, 0.01);  // lowered smoothly
  EXPECT_TRUE(raised(rig, Fault::MotorHot));
}

TEST(MotorHeat, AForceOfTheContinuousRatingIsNeverCut) {
  device::DeviceProfile profile;
  Rig rig(full_share(), profile);
  rig.open();
  double sent_N = 0.0;
  for (int i = 0; i < 120'000; ++i) sent_N = rig.tick(Vec3(profile.continuous_force_N, 0, 0)).norm();
  EXPECT_NEAR(sent_N, profile.continuous_force_N, 1e-12);
}

TEST(Faults, EachHasATextWithARemedyOnce) {
  std::uint32_t seen = 0;
  for (const FaultText& text : fault_texts()) {
    EXPECT_EQ(seen & bit(text.fault), 0u);
    seen |= bit(text.fault);
    EXPECT_FALSE(text.name.empty());
    EXPECT_GT(text.remedy.size(), 20u);
  }
  EXPECT_EQ(seen, (bit(Fault::WatchdogCut) << 1) - 1);  // no gap up to the last one
  EXPECT_EQ(describe_faults(bit(Fault::Stopped) | bit(Fault::Buzz)).size(), 2u);
}

}  // namespace
}  // namespace myotact::haptics
