#include "haptics/gate/force_gate.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "haptics/faults.h"
#include "haptics/gate_rig.h"

namespace myotact::haptics {
namespace {

TEST(ForceGate, ShutUntilEnabled) {
  ForceGate gate{device::DeviceProfile{}, GateSettings{}};
  GateInput input;
  input.wanted_N = Vec3(1, 0, 0);
  input.has_model = true;
  EXPECT_EQ(gate.admit(input).norm(), 0.0);
  EXPECT_EQ(gate.state(), GateState::Off);
}

TEST(ForceGate, StaysArmedWhileAForceIsWantedFromTheStart) {
  Rig rig;
  for (int i = 0; i < 500; ++i) EXPECT_EQ(rig.tick(Vec3(1, 0, 0)).norm(), 0.0);
  EXPECT_EQ(rig.gate.state(), GateState::Armed);
}

TEST(ForceGate, RampsUpOverOneSecond) {
  Rig rig;
  rig.tick(Vec3::Zero());
  EXPECT_EQ(rig.gate.state(), GateState::Ramp);
  for (int i = 1; i < 500; ++i) rig.tick(Vec3(1, 0, 0));
  EXPECT_NEAR(rig.tick(Vec3(1, 0, 0)).x(), 0.5, 0.01);
  for (int i = 0; i < 510; ++i) rig.tick(Vec3(1, 0, 0));
  EXPECT_EQ(rig.gate.state(), GateState::On);
  EXPECT_NEAR(rig.tick(Vec3(1, 0, 0)).x(), 1.0, 1e-12);
}

TEST(ForceGate, ClampsToThePeakAndKeepsTheDirection) {
  Rig rig;
  rig.open();
  Vec3 sent_N = Vec3::Zero();
  for (int i = 0; i < 50; ++i) sent_N = rig.tick(Vec3(300, 400, 0));
  EXPECT_NEAR((sent_N - kPeak_N * Vec3(0.6, 0.8, 0)).norm(), 0.0, 1e-9);
}

TEST(ForceGate, LimitsTheRiseOnly) {
  Rig rig;
  rig.open();
  for (int i = 1; i <= 10; ++i) EXPECT_NEAR(rig.tick(Vec3(3.2, 0, 0)).norm(), std::min(3.2, i * kSlewPerTick_N), 1e-9);
  EXPECT_EQ(rig.tick(Vec3::Zero()).norm(), 0.0);  // letting go is never late
}

TEST(ForceGate, WhileTheToolChangesItFadesOutAndThenComesBackThroughTheRamp) {
  Rig rig;
  rig.open();
  for (int i = 0; i < 20; ++i) rig.tick(Vec3(1, 0, 0));
  rig.input.changing = true;
  for (int i = 1; i < 100; ++i) EXPECT_NEAR(rig.tick(Vec3(1, 0, 0)).x(), 1.0 - 0.01 * i, 1e-9);
  EXPECT_FALSE(rig.gate.is_shut());
  for (int i = 0; i < 300; ++i) rig.tick(Vec3(1, 0, 0));
  EXPECT_TRUE(rig.gate.is_shut());
  EXPECT_EQ(rig.tick(Vec3(1, 0, 0)).norm(), 0.0);
  rig.input.changing = false;
  for (int i = 1; i <= 500; ++i) EXPECT_NEAR(rig.tick(Vec3(1, 0, 0)).x(), 1e-3 * i, 1e-9);
}

TEST(ForceGate, NotANumberGivesZeroAndComesBackThroughTheRamp) {
  Rig rig;
  rig.open();
  for (int i = 0; i < 20; ++i) rig.tick(Vec3(1, 0, 0));
  EXPECT_EQ(rig.tick(Vec3(std::numeric_limits<double>::quiet_NaN(), 0, 0)).norm(), 0.0);
  EXPECT_NE(rig.gate.faults() & bit(Fault::NonFiniteForce), 0u);
  EXPECT_EQ(rig.tick(Vec3(0, std::numeric_limits<double>::infinity(), 0)).norm(), 0.0);
  EXPECT_LT(rig.tick(Vec3(1, 0, 0)).norm(), 0.01);
  EXPECT_EQ(rig.gate.state(), GateState::Ramp);
}

TEST(ForceGate, StopAndLossOfTheDeviceGiveZeroAtOnce) {
  Rig rig;
  rig.open();
  for (int i = 0; i < 20; ++i) rig.tick(Vec3(2, 0, 0));
  rig.input.connected = false;
  EXPECT_EQ(rig.tick(Vec3(2, 0, 0)).norm(), 0.0);
  EXPECT_NE(rig.gate.faults() & bit(Fault::DeviceLost), 0u);
  EXPECT_EQ(rig.gate.state(), GateState::Armed);
  rig.input.connected = true;
  rig.open();
  rig.tick(Vec3(0.3, 0, 0));
  rig.gate.stop();
  EXPECT_EQ(rig.tick(Vec3(0.3, 0, 0)).norm(), 0.0);
  EXPECT_EQ(rig.gate.state(), GateState::Off);
  EXPECT_NE(rig.gate.faults() & bit(Fault::Stopped), 0u);
}

TEST(ForceGate, AClutchGivesZeroAtOnceWithoutAFaultAndTheRampAfterwards) {
  Rig rig;
  rig.open();
  for (int i = 0; i < 20; ++i) rig.tick(Vec3(2, 0, 0));
  rig.input.clutched = true;
  EXPECT_EQ(rig.tick(Vec3(2, 0, 0)).norm(), 0.0);
  EXPECT_EQ(rig.gate.faults(), 0u);
  rig.input.clutched = false;
  EXPECT_EQ(rig.tick(Vec3(2, 0, 0)).norm(), 0.0) << "armed: the hand came back inside of something";
  rig.tick(Vec3(0.1, 0, 0));
  EXPECT_EQ(rig.gate.state(), GateState::Ramp);
  EXPECT_LT(rig.tick(Vec3(2, 0, 0)).norm(), 0.01);
}

TEST(ForceGate, AStaleModelFadesFromThirtyMillisecondsToZeroAtAHundred) {
  Rig rig;
  rig.open();
  for (int i = 0; i < 20; ++i) rig.tick(Vec3(1, 0, 0));
  rig.publishes = false;
  rig.input.model_arrived_ns = rig.now_ns;
  double last_N = 1.0;
  for (int age_ms = 1; age_ms <= 120; ++age_ms) {
    const double sent_N = rig.tick(Vec3(1, 0, 0)).norm();
    if (age_ms <= 30) {
      EXPECT_NEAR(sent_N, 1.0, 1e-12);
    }
    if (age_ms == 65) {
      EXPECT_NEAR(sent_N, 0.5, 0.02);
    }
    if (age_ms >= 100) {
      EXPECT_EQ(sent_N, 0.0);
    }
    EXPECT_LE(sent_N, last_N + 1e-12);
    last_N = sent_N;
  }
  EXPECT_EQ(rig.gate.state(), GateState::Fade);
  rig.publishes = true;
  rig.input.model_arrived_ns = rig.now_ns;
  EXPECT_LT(rig.tick(Vec3(1, 0, 0)).norm(), 0.01);
  EXPECT_EQ(rig.gate.state(), GateState::Ramp);
}

TEST(ForceGate, AModelThatNeverCameLetsNothingThrough) {
  ForceGate gate{device::DeviceProfile{}, GateSettings{}};
  gate.enable();
  GateInput input;
  for (int i = 0; i < 100; ++i) {
    input.now_ns += kTick_ns;
    EXPECT_EQ(gate.admit(input).norm(), 0.0);
  }
  EXPECT_EQ(gate.state(), GateState::Armed);
}

TEST(ForceGate, DampsWhatGivesMoreEnergyThanItGot) {
  Rig rig;
  rig.open();
  // A "wall" that always pushes along the motion: 1 N over 0.5 m/s is half a watt from nothing.
  double work_J = 0.0;
  Vec3 position_m = Vec3::Zero();
  Vec3 sent_N = Vec3::Zero();
  for (int i = 0; i < 2000; ++i) {
    const double velocity_m_s = 0.5 * std::cos(0.02 * i);
    position_m.x() += 1e-3 * velocity_m_s;
    work_J += sent_N.x() * 1e-3 * velocity_m_s;
    sent_N = rig.tick(Vec3(velocity_m_s > 0 ? 1.0 : -1.0, 0, 0), position_m);
  }
  const GateSettings settings;
  EXPECT_LT(work_J, settings.energy_store_J + settings.active_power_W * 2.0 + 0.01);
  EXPECT_NE(rig.gate.faults() & bit(Fault::EnergyInjected), 0u);
}

TEST(ForceGate, ASpringThatGivesBackWhatItTookIsLeftAlone) {
  Rig rig;
  rig.open();
  for (int i = 0; i < 3000; ++i) {
    const double x_m = 4e-3 * std::sin(0.01 * i);
    const double depth_m = std::max(0.0, x_m);
    const Vec3 wanted_N(-800.0 * depth_m, 0, 0);
    const Vec3 sent_N = rig.tick(wanted_N, Vec3(x_m, 0, 0));
    if (i > 10) {
      ASSERT_NEAR(sent_N.x(), wanted_N.x(), 1e-9) << i;
    }
  }
}

TEST(ForceGate, WhateverComesTheForceIsFiniteAndWithinThePeak) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Rig rig;
  rig.open();
  double last_N = 0.0;
  Vec3 position_m = Vec3::Zero();
  for (int i = 0; i < 20'000; ++i) {
    Vec3 wanted_N = std::pow(10.0, 4.0 * unit(random)) * Vec3(unit(random), unit(random), unit(random));
    if (i % 97 == 0) wanted_N.y() = std::numeric_limits<double>::quiet_NaN();
    if (i % 1000 == 0) rig.publishes = !rig.publishes;
    const double yank_m_s = i % 500 < 50 ? 3.0 : 0.1;
    position_m += 1e-3 * yank_m_s * Vec3(unit(random), unit(random), unit(random));
    const Vec3 sent_N = rig.tick(wanted_N, position_m);
    ASSERT_TRUE(sent_N.allFinite());
    ASSERT_LE(sent_N.norm(), kPeak_N + 1e-12);
    if ((rig.gate.faults() & bit(Fault::EnergyInjected)) == 0) {
      ASSERT_LE(sent_N.norm(), last_N + kSlewPerTick_N + 1e-9);
    }
    last_N = sent_N.norm();
  }
}

}  // namespace
}  // namespace myotact::haptics
