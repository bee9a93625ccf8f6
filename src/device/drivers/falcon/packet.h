#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace myotact::device::falcon {

// What goes over the wire once the firmware runs: 16 bytes each way, '<', 14 bytes of a nibble each (0x41 added), '>';
// a number of 16 bits is four nibbles, the lowest first. Every command is answered by one report. (Layout: libnifalcon,
// BSD.)

inline constexpr std::size_t kPacketBytes = 16;
inline constexpr int kMostCounts = 4095;  // of a motor, either way; more wraps round to the opposite force
using Packet = std::array<std::uint8_t, kPacketBytes>;

/// To the device.
struct Command {
  std::array<std::int16_t, 3> motor_counts{};  // beyond kMostCounts they are cut
  bool homes = true;                           // to count from its stops, as soon as the hand has been at them
};

inline constexpr std::uint8_t kPlus = 1, kFront = 2, kCentre = 4, kMinus = 8;  // buttons: right, front, middle, left

/// From the device.
struct Report {
  std::array<std::int16_t, 3> encoder_counts{};
  std::array<bool, 3> is_homed{};
  std::uint8_t buttons = 0;  // of the ball grip: kPlus ...

  bool all_homed() const noexcept { return is_homed[0] && is_homed[1] && is_homed[2]; }
};

/// The bits of messages::DeviceState: the centre button takes hold of a muscle, plus of a bone, minus is the clutch,
/// the front one stops.
std::uint32_t stylus_buttons(std::uint8_t buttons) noexcept;

Packet encode(const Command& command) noexcept;
/// Nothing: not a report.
std::optional<Report> decode(const Packet& packet) noexcept;
/// For what plays the device.
Command decode_command(const Packet& packet) noexcept;
Packet encode(const Report& report) noexcept;

/// Puts the bytes of USB transfers together to packets. Each transfer of the serial chip begins with two bytes of
/// status; a packet may come in parts, or several at once, with anything between. Allocates nothing.
class PacketReader {
 public:
  /// One IN transfer as it came.
  void take_transfer(std::span<const std::uint8_t> transfer) noexcept;
  /// The next whole packet, oldest first.
  std::optional<Packet> next() noexcept;
  std::uint64_t skipped_bytes() const noexcept { return skipped_; }

 private:
  static constexpr std::size_t kKept = 256;  // four full transfers: a slower reader would get outdated reports anyway

  std::array<std::uint8_t, kKept> bytes_{};
  std::size_t begin_ = 0, count_ = 0;
  std::uint64_t skipped_ = 0;
};

}  // namespace myotact::device::falcon
