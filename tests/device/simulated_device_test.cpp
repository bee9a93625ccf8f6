#include "device/simulated_device.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace myotact::device {
namespace {

constexpr std::uint64_t kTick_ns = 1'000'000;

DeviceProfile frictionless() {
  DeviceProfile profile;
  profile.coulomb_N = 0.0;
  profile.resolution_m = 0.0;
  return profile;
}

messages::DeviceState run(SimulatedDevice& device, int ticks, std::uint64_t& now_ns) {
  messages::DeviceState state;
  for (int tick = 0; tick < ticks; ++tick) state = device.read(now_ns += kTick_ns);
  return state;
}

TEST(SimulatedDevice, RestsWhereItStarts) {
  SimulatedDevice device("simulated", Vec3(0.1, 0.2, 0.3));
  std::uint64_t now_ns = 0;
  const messages::DeviceState state = run(device, 100, now_ns);
  EXPECT_NEAR((to_vec3(state.stylus_position_world_m) - Vec3(0.1, 0.2, 0.3)).norm(), 0.0, 1e-9);
  EXPECT_EQ(state.sampled_at_ns, now_ns);
}

TEST(SimulatedDevice, PullsWithNoMoreThanItsPeak) {
  SimulatedDevice device("simulated", Vec3::Zero());
  device.write({{30.0, 40.0, 0.0}});
  EXPECT_NEAR((device.motor_force_N() - DeviceProfile{}.peak_force_N * Vec3(0.6, 0.8, 0.0)).norm(), 0.0, 1e-12);
}

/// Closed form: a driven oscillator's amplitude |k| / |k - m w^2 + i w (b + b_device)|.
TEST(SimulatedDevice, TremblesAsADrivenOscillatorDoes) {
  HandProfile hand;
  hand.tremor_m = 2e-4;
  const DeviceProfile profile = frictionless();
  SimulatedDevice device("simulated", Vec3::Zero(), profile, hand);
  std::uint64_t now_ns = 0;
  run(device, 3000, now_ns);
  double largest_m = 0.0;
  for (int tick = 0; tick < 1000; ++tick)
    largest_m = std::max(largest_m, run(device, 1, now_ns).stylus_position_world_m[0]);
  const double w = 2.0 * std::numbers::pi * 9.0;
  const double real = hand.stiffness_N_m - (hand.mass_kg + profile.inertia_kg) * w * w;
  const double imaginary = w * (hand.damping_Ns_m + profile.viscous_Ns_m);
  EXPECT_NEAR(largest_m, hand.tremor_m * hand.stiffness_N_m / std::hypot(real, imaginary), 0.02 * hand.tremor_m);
}

TEST(SimulatedDevice, SettlesAtForceOverHandStiffness) {
  SimulatedDevice device("simulated", Vec3::Zero(), frictionless());
  device.write({{0.6, 0.0, 0.0}});
  std::uint64_t now_ns = 0;
  run(device, 3000, now_ns);
  EXPECT_NEAR(device.position_world_m().x(), 0.6 / HandProfile{}.stiffness_N_m, 1e-6);
}

TEST(SimulatedDevice, SwingsWithThePeriodOfItsMassAndSpring) {
  HandProfile hand;
  hand.damping_Ns_m = 0.0;
  DeviceProfile profile = frictionless();
  profile.viscous_Ns_m = 0.0;
  SimulatedDevice device("simulated", Vec3::Zero(), profile, hand);
  device.set_hand_target({{0.01, 0.0, 0.0}, {}, 0});
  const double period_s = 2.0 * std::numbers::pi * std::sqrt((profile.inertia_kg + hand.mass_kg) / hand.stiffness_N_m);
  std::uint64_t now_ns = 0;
  run(device, static_cast<int>(std::lround(500.0 * period_s)) + 1, now_ns);  // half a period
  EXPECT_NEAR(device.position_world_m().x(), 0.02, 2e-4);  // 1 %: what the implicit step damps in half a swing
}

TEST(SimulatedDevice, FrictionHoldsAgainstASmallForce) {
  DeviceProfile profile = frictionless();
  profile.coulomb_N = 0.2;
  SimulatedDevice device("simulated", Vec3::Zero(), profile);
  device.write({{0.19, 0.0, 0.0}});
  std::uint64_t now_ns = 0;
  run(device, 200, now_ns);
  EXPECT_EQ(device.position_world_m().x(), 0.0);
}

TEST(SimulatedDevice, EncoderRoundsAndVelocityFollows) {
  SimulatedDevice device("simulated", Vec3::Zero());
  std::uint64_t now_ns = 0;
  messages::DeviceState state;
  for (int tick = 1; tick <= 1000; ++tick) {
    device.set_hand_target({{1e-4 * tick, 0.0, 0.0}, {0.1, 0.0, 0.0}, messages::kGrabButton});
    state = device.read(now_ns += kTick_ns);
  }
  const double counts = state.stylus_position_world_m[0] / DeviceProfile{}.resolution_m;
  EXPECT_NEAR(counts, std::round(counts), 1e-6);
  EXPECT_NEAR(state.stylus_velocity_world_m_s[0], 0.1, 0.01);
  EXPECT_EQ(state.buttons, messages::kGrabButton);
}

TEST(SimulatedDevice, AForgottenTargetStops) {
  SimulatedDevice device("simulated", Vec3::Zero(), frictionless());
  device.set_hand_target({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0});
  std::uint64_t now_ns = 0;
  run(device, 2000, now_ns);
  EXPECT_LT(device.position_world_m().x(), 0.06);  // 1 m/s for the 50 ms that a target lives, and no farther
}

}  // namespace
}  // namespace myotact::device
