#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace myotact::device::spacemouse {

/// How far the cap of a SpaceMouse is pushed and rotated, in counts of the device, along and about its own raw axes
/// (+X to the right, +Y towards the person, +Z down: `motion.h` changes them to ours).
struct Cap {
  std::array<int, 3> push{};      // -kFullDeflection .. kFullDeflection
  std::array<int, 3> rotation{};  // the same range
  std::uint32_t keys = 0;         // bit i: bit i of the button bytes, least significant byte first
  int battery_percent = -1;       // 0 .. 100; below 0: not reported yet
};

/// Logical maximum of the axes in the report descriptors. Some models go a little beyond: clamped.
inline constexpr int kFullDeflection = 350;
/// Room for a report: a full-speed packet. The longest that a model sends is 13 bytes.
inline constexpr std::size_t kLongestReport = 64;

/// Input reports: the first byte is the id.
inline constexpr std::uint8_t kPushReport = 0x01;      // 7 bytes: push alone; 13 or more: push and rotation
inline constexpr std::uint8_t kRotationReport = 0x02;  // 7 bytes
inline constexpr std::uint8_t kKeysReport = 0x03;      // 2 to 5 bytes used
inline constexpr std::uint8_t kBatteryReport = 0x17;   // wireless models: percent in byte 1

/// Output report that switches the light of the cap.
constexpr std::array<std::uint8_t, 2> light_report(bool on) {
  return {0x04, static_cast<std::uint8_t>(on ? 1 : 0)};
}

/// Changes of `cap` what the report contains. False: the report is of another kind or too short, and nothing is
/// changed. Models that put push and rotation into one report are recognised by its length, not by a list of models.
bool apply_report(std::span<const std::uint8_t> report, Cap& cap) noexcept;

/// Keys of the models with many (Pro, Enterprise), whose bits have gaps. The models with two have bits 0 and 1: left
/// and right.
enum class Key : std::uint8_t {
  Menu = 0,
  Fit = 1,
  Top = 2,
  Right = 4,
  Front = 5,
  Roll = 8,
  One = 12,
  Two = 13,
  Three = 14,
  Four = 15,
  Escape = 22,
  Alt = 23,
  Shift = 24,
  Control = 25,
  Lock = 26
};
constexpr std::uint32_t bit_of(Key key) {
  return std::uint32_t{1} << static_cast<unsigned>(key);
}

/// The bits of messages::DeviceState: the left key (Menu of a Pro) and 1 grab a muscle, the right key (Fit) and 2 a
/// bone, Escape stops. One map for all models: those with two keys never set the higher bits. Not bit by bit, since
/// Top of a Pro has the place of our emergency stop.
std::uint32_t stylus_buttons(std::uint32_t keys) noexcept;

}  // namespace myotact::device::spacemouse
