#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

namespace myotact::messages {

/// What the haptic loop reads from any device. Crosses threads by value.
struct DeviceState {
  std::array<double, 3> stylus_position_world_m{};
  std::array<double, 3> stylus_velocity_world_m_s{};  // low-passed by the driver
  std::uint64_t sampled_at_ns = 0;                    // steady clock of this host, or the virtual clock
  std::uint32_t buttons = 0;                          // bit i set: button i is down
};

/// What the haptic loop writes to any device, after the force gate.
struct DeviceCommand {
  std::array<double, 3> force_world_N{};
};

inline constexpr std::uint32_t kGrabButton = 1u << 0;      // held: the nearest muscle line is in hand
inline constexpr std::uint32_t kGrabBoneButton = 1u << 1;  // held: the nearest point of a bone is in hand
/// Held: the hand moves on the table and the tool stays where it is. No force meanwhile; it comes back through the
/// ramp.
inline constexpr std::uint32_t kClutchButton = 1u << 3;
inline constexpr std::uint32_t kStopButton = 1u << 2;  // pressed: emergency stop; releasing it re-enables nothing

static_assert(std::is_trivially_copyable_v<DeviceState> && std::is_trivially_copyable_v<DeviceCommand>);

}  // namespace myotact::messages
