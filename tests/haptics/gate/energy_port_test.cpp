// Ports against closed forms: what a held force gives, what a spring may give back, what a muscle may.

#include "haptics/gate/energy_port.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "haptics/effects/line_effect.h"
#include "haptics/gate/haptic_ports.h"

namespace myotact::haptics {
namespace {

constexpr double kTick_s = 1e-3;
constexpr double kMost_Ns_m = 28.0;  // 0.4 m / T of 70 g

PortTick along_x(double wanted_N, double moved_m, double stored_J = 0.0, double environment_m = 0.0) {
  PortTick tick;
  tick.wanted_N.x() = wanted_N;
  tick.hand_moved_m.x() = moved_m;
  tick.environment_moved_m.x() = environment_m;
  tick.stored_J = stored_J;
  tick.most_damping_Ns_m = kMost_Ns_m;
  tick.dt_s = kTick_s;
  return tick;
}

TEST(EnergyPort, BooksTheForceThatWasSentOverTheWayThatFollowed) {
  EnergyPort port;
  port.admit(along_x(-1.0, 0.0));
  port.book(0.5);                        // the gate let half of it through
  port.admit(along_x(-1.0, 2e-4, 1.0));  // 0.2 mm against 0.5 N
  EXPECT_NEAR(port.energy_J(), 1e-4, 1e-15);
}

// Pushing the hand with 1 N over 0.1 mm a tick gives 0.1 mJ a tick from nothing: damping takes it back in the next one.
TEST(EnergyPort, TakesBackWhatCameFromNothing) {
  EnergyPort port;
  double out_J = 0.0, most_J = 0.0;
  Vec3 sent_N = Vec3::Zero();
  for (int i = 0; i < 2000; ++i) {
    const double moved_m = 1e-4;
    out_J += sent_N.x() * moved_m;
    most_J = std::max(most_J, out_J);
    sent_N = port.admit(along_x(1.0, moved_m));
    port.book(1.0);
  }
  EXPECT_LT(most_J, 0.2e-3);  // two ticks' worth: one to see it, one to answer
  EXPECT_LT(out_J, 1.01e-4);
}

TEST(EnergyPort, DampingIsNoMoreThanTheDeviceBears) {
  EnergyPort port;
  for (int i = 0; i < 100; ++i) {
    port.admit(along_x(10.0, 1e-5));
    port.book(1.0);
    EXPECT_LE(port.damping_Ns_m(), kMost_Ns_m);
  }
}

// A spring held for a minute still gives back all that it took: what is stored is no surplus.
TEST(EnergyPort, ASpringThatWasHeldForLongIsLeftAlone) {
  EnergyPort port;
  const double k = 800.0;
  double x_m = 0.0;
  const auto go = [&](double moved_m) {
    x_m += moved_m;
    // A spring without the half tick by which a held force lags: F at the middle of the way to come.
    const double force_N = -k * (x_m + 0.5 * moved_m);
    const Vec3 asked_N = port.admit(along_x(force_N, moved_m, 0.5 * k * x_m * x_m));
    port.book(1.0);
    EXPECT_NEAR(asked_N.x(), force_N, 0.02) << x_m;
  };
  for (int i = 0; i < 400; ++i) go(1e-5);
  for (int i = 0; i < 60'000; ++i) go(0.0);
  for (int i = 0; i < 399; ++i) go(-1e-5);
}

/// Energy that is missing after a spring of 400 N/m was pressed and let go in 10 steps of 0.1 mm each way.
double missing_after_steps_J(double friction_J) {
  EnergyPort port;
  const double k = 400.0;
  double x_m = 0.0;
  for (int i = 0; i <= 20; ++i) {
    const double moved_m = i == 0 ? 0.0 : i <= 10 ? 1e-4 : -1e-4;
    PortTick tick = along_x(-k * (x_m + moved_m), moved_m, 0.5 * k * (x_m + moved_m) * (x_m + moved_m));
    tick.spring_gave_J = 0.5 * k * x_m * x_m - tick.stored_J;
    tick.friction_J = friction_J;
    tick.most_damping_Ns_m = 0.0;
    x_m += moved_m;
    port.admit(tick);
    port.book(1.0);
  }
  return port.missing_J();
}

// A held force gives k dx^2 / 2 a tick: 2 uJ, 20 times.
TEST(EnergyPort, WhatAHeldForceGivesIsMissingAsFarAsTheDevicesFrictionLeavesIt) {
  EXPECT_NEAR(missing_after_steps_J(0.0), 40e-6, 1e-12);
  EXPECT_NEAR(missing_after_steps_J(1.5e-6), 10e-6, 1e-12);
  EXPECT_NEAR(missing_after_steps_J(2e-6), 0.0, 1e-12);
  EXPECT_NEAR(missing_after_steps_J(1.0), 0.0, 1e-12);  // and no more than that
}

TEST(EnergyPort, WhatFrictionTookIsForgottenAndNeverMoreThanTheStore) {
  const PortSettings settings;
  EnergyPort port(settings);
  for (int i = 0; i < 1000; ++i) {  // 1 N of friction over 100 mm: 100 mJ
    port.admit(along_x(-1.0, 1e-4));
    port.book(1.0);
  }
  EXPECT_LE(port.energy_J(), settings.store_J);
  const double full_J = port.energy_J();
  for (int i = 0; i < 1000; ++i) port.admit(along_x(0.0, 0.0));
  EXPECT_NEAR(port.energy_J(), full_J * std::exp(-1.0 / settings.leak_s), 1e-3 * full_J);
}

// ---- a muscle's own work against a loop that swings

/// Energy that the port lets out in two seconds to a hand that an environment shoves by amplitude * sin(2 pi f t) with
/// a force that leads the motion so that all of it is work: F = 1 N + 0.5 N cos.
double swing_out_J(double frequency_hz, double amplitude_m) {
  EnergyPort port;
  double out_J = 0.0, last_m = 0.0;
  Vec3 sent_N = Vec3::Zero();
  for (int i = 0; i < 2000; ++i) {
    const double phase = 2.0 * std::numbers::pi * frequency_hz * i * kTick_s;
    const double x_m = amplitude_m * std::sin(phase);
    const double moved_m = x_m - last_m;
    last_m = x_m;
    out_J += sent_N.x() * moved_m;
    sent_N = port.admit(along_x(1.0 + 0.5 * std::cos(phase), moved_m, 0.0, moved_m));
    port.book(1.0);
  }
  return out_J;
}

// Work wanted a cycle: pi F amplitude = 0.5 N pi amplitude.
// What swings touches again at once; a hand that has left the tissue is not held back for long.
TEST(EnergyPort, AHandThatLetsGoIsFreeOfWhatSwung) {
  EnergyPort port;
  double missing_J = 0.0;
  for (int i = 0; i < 400; ++i) {  // 25 Hz, 1 mm, the force as the speed
    const double speed = std::cos(2.0 * std::numbers::pi * 25.0 * 1e-3 * i);
    port.admit(along_x(speed, 0.0, 0.0, 1e-3 * 2.0 * std::numbers::pi * 25.0 * 1e-3 * speed));
    port.book(1.0);
    missing_J = port.missing_J();
  }
  EXPECT_GT(missing_J, 5e-3);
  for (int i = 0; i < 150; ++i) {
    PortTick away = along_x(0.0, 1e-4);
    away.opens = true;
    port.admit(away);
    port.book(1.0);
  }
  EXPECT_EQ(port.missing_J(), 0.0);
}

TEST(EnergyPort, LetsTheSlowWorkOfAMuscleThroughAndNotAFastSwing) {
  const double amplitude_m = 2e-3;
  const double slow_J = swing_out_J(1.0, amplitude_m), slow_wanted_J = 2.0 * 0.5 * std::numbers::pi * amplitude_m;
  EXPECT_GT(slow_J, 0.7 * slow_wanted_J);
  const double fast_J = swing_out_J(25.0, amplitude_m), fast_wanted_J = 50.0 * 0.5 * std::numbers::pi * amplitude_m;
  EXPECT_LT(fast_J, 0.15 * fast_wanted_J);
  std::printf("let out at 1 Hz %.2f of %.2f mJ, at 25 Hz %.1f of %.1f mJ\n", 1e3 * slow_J, 1e3 * slow_wanted_J,
              1e3 * fast_J, 1e3 * fast_wanted_J);
}

TEST(EnergyPort, NoNumberLeavesItUsable) {
  EnergyPort port;
  port.admit(along_x(1.0, 0.0));
  port.book(1.0);
  port.admit(along_x(1.0, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_TRUE(std::isfinite(port.energy_J()));
  port.book(1.0);
  EXPECT_EQ(port.admit(along_x(1.0, -1e-6)).x(), 1.0);
}

// ---- the string of a muscle line

TEST(StringEnergy, IsTheWorkOfItsForceOnTheHand) {
  messages::LocalLine line;
  line.proximal_point_world_m = {-0.1, 0, 0};
  line.distal_point_world_m = {0.1, 0, 0};
  line.length_m = 0.2;
  line.stiffness_N_m = 300.0;
  for (const double tension_N : {5.0, 0.0, -0.5}) {  // the last one is slack until it is 1.7 mm longer
    line.tension_N = tension_N;
    double work_J = 0.0;
    const double step_m = 1e-6;
    for (double d_m = 0.5 * step_m; d_m < 0.03; d_m += step_m) {
      const double half_m = std::hypot(0.1, d_m);
      const double T = std::max(0.0, tension_N + 300.0 * (2.0 * half_m - 0.2));
      work_J += 2.0 * T * d_m / half_m * step_m;
    }
    EXPECT_NEAR(string_energy_J(line, Vec3(0, 0, 0.03)), work_J, 1e-6) << tension_N;
  }
}

/// Largest difference between wanted and asked while a line is drawn 50 mm aside and let back, 20 times, slowly, by an
/// encoder of 20 um. On the way back the muscle pulls harder by `gives_away`, of which the line's port hears nothing.
double largest_change_N(double coulomb_N, double gives_away) {
  device::DeviceProfile profile;
  profile.coulomb_N = coulomb_N;
  profile.viscous_Ns_m = 0.0;
  HapticPorts ports(profile);
  HapticSettings settings;
  settings.force_scale = 0.02;
  LineEffect line(settings, profile);
  EffectNotes notes;
  messages::LocalModel model;
  model.line.muscle = 0;
  model.line.proximal_point_world_m = {-0.1, 0, 0};
  model.line.distal_point_world_m = {0.1, 0, 0};
  model.line.length_m = 0.2;
  model.line.stiffness_N_m = 600.0;
  model.line.tension_N = 20.0;
  double largest_N = 0.0;
  for (int i = 0; i < 80'000; ++i) {
    const double aside_m = 0.025 * (1.0 - std::cos(2.0 * std::numbers::pi * i / 4000.0));
    HandTick hand;
    hand.hand.position_m.z() = 20e-6 * std::round(aside_m / 20e-6);
    hand.model = &model;
    hand.buttons = i > 0 ? messages::kGrabButton : 0u;
    const EffectTick tick = line.tick(hand, notes);
    std::array<PortTick, 1> port{tick.port};
    port[0].wanted_N = tick.force_N * (i % 4000 >= 2000 ? 1.0 + gives_away : 1.0);
    const Vec3 asked_N = ports.admit(port, {hand.hand.position_m, hand.dt_s});
    largest_N = std::max(largest_N, (asked_N - port[0].wanted_N).norm());
    ports.book(asked_N);
  }
  return largest_N;
}

// Without friction of the device the same counts read as energy that came from nothing, as far as anyone here can tell.
TEST(HapticPorts, AnEncodersCountsAreNoEnergyOfALineInHand) {
  EXPECT_LT(largest_change_N(0.1, 0.0), 1e-3);
  EXPECT_GT(largest_change_N(0.0, 0.0), 1e-2);
}

// A string that pulls harder on the way back than on the way out by more than friction holds back is no string.
TEST(HapticPorts, ALineThatGivesMoreThanItTookIsDamped) {
  EXPECT_GT(largest_change_N(0.01, 0.1), 1e-2);
}

TEST(HapticPorts, TogetherTheyDampNoMoreThanTheDeviceBears) {
  device::DeviceProfile profile;
  profile.inertia_kg = 0.07;
  profile.delay_ticks = 1;
  profile.resolution_m = 1e-6;
  HapticPorts ports(profile);
  PortsHand hand;
  hand.dt_s = kTick_s;
  for (int i = 0; i < 200; ++i) {  // all effects push along the motion
    hand.position_m.x() += 1e-5;
    std::array<PortTick, 3> ticks;
    for (PortTick& tick : ticks) tick.wanted_N = Vec3(5, 0, 0);
    const Vec3 asked_N = ports.admit(ticks, hand);
    EXPECT_LE(ports.damping_Ns_m(), 0.4 / 2 * 0.07 / kTick_s + 1e-9);
    ports.book(asked_N);
  }
  EXPECT_GT(ports.damping_Ns_m(), 0.0);
}

TEST(HapticPorts, RoundingOfTheEncoderIsNoMotionToDamp) {
  device::DeviceProfile profile;
  profile.coulomb_N = profile.viscous_Ns_m = 0.0;
  HapticPorts ports(profile);
  PortsHand hand;
  hand.dt_s = kTick_s;
  const auto push_along = [&](double way_m, int ticks) {
    for (int i = 0; i < ticks; ++i) {
      hand.position_m += Vec3::Constant(way_m);
      std::array<PortTick, 1> port;
      port[0].wanted_N = Vec3(5, 0, 0);
      ports.book(ports.admit(port, hand));
    }
  };
  push_along(profile.resolution_m, 50);  // one count on each axis
  EXPECT_GT(ports.missing_J(), 1e-3);
  EXPECT_EQ(ports.damping_Ns_m(), 0.0);
  push_along(2.0 * profile.resolution_m, 1);
  EXPECT_GT(ports.damping_Ns_m(), 0.0);
}

}  // namespace
}  // namespace myotact::haptics
