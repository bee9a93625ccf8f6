#pragma once

#include <cstdint>

#include <gtest/gtest.h>

#include "haptics/gate/force_gate.h"

namespace myotact::haptics {

inline constexpr std::uint64_t kTick_ns = 1'000'000;
inline constexpr double kPeak_N = device::DeviceProfile{}.peak_force_N;
/// The whole peak may be sent, for ever, and the device may move as fast as the test likes.
inline GateSettings full_share() {
  GateSettings settings;
  settings.force_limit = 1.0;
  return settings;
}
inline device::DeviceProfile cool_motors() {
  device::DeviceProfile profile;
  profile.continuous_force_N = profile.peak_force_N;
  return profile;
}

inline constexpr double kSlewPerTick_N = GateSettings{}.slew_N_s * 1e-3;

/// A gate with a clock and a simulation that publishes every 10 ms while `publishes`.
struct Rig {
  explicit Rig(const GateSettings& settings = full_share(), const device::DeviceProfile& profile = cool_motors())
      : gate(profile, settings) {
    gate.enable();
    input.model_arrived_ns = now_ns;
  }

  Vec3 tick(const Vec3& wanted_N, const Vec3& position_m = Vec3::Zero()) {
    now_ns += kTick_ns;
    if (publishes && now_ns % (10 * kTick_ns) == 0) input.model_arrived_ns = now_ns;
    input.has_model = true;
    input.step_ns = 10 * kTick_ns;
    input.now_ns = now_ns;
    input.wanted_N = wanted_N;
    input.device_position_m = position_m;
    return gate.admit(input);
  }
  void open() {
    for (int i = 0; i < 1200; ++i) tick(Vec3::Zero());
    ASSERT_EQ(gate.state(), GateState::On);
  }

  ForceGate gate;
  GateInput input;
  std::uint64_t now_ns = 1'000'000'000;
  bool publishes = true;
};

}  // namespace myotact::haptics
