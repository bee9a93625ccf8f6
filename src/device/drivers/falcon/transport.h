#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

namespace myotact::device::falcon {

/// The USB side of one Falcon, opened: the serial chip's requests, and transfers in and out. One thread. Nothing
/// throws: what goes wrong shows in the answers.
class Transport {
 public:
  virtual ~Transport() = default;

  /// A vendor request to the serial chip. False: refused, or the device is gone.
  virtual bool request(std::uint8_t number, std::uint16_t value) noexcept = 0;
  /// Queues bytes for the device. False: not taken.
  virtual bool send(std::span<const std::uint8_t> bytes) noexcept = 0;
  /// The oldest transfer that came in, its two bytes of status included, into `bytes` (64 or more): how many; 0 when
  /// none came within `patience` (0: none lies there yet).
  virtual std::size_t receive(std::span<std::uint8_t> bytes, std::chrono::milliseconds patience) noexcept = 0;
  /// The device was unplugged, or does not answer requests any more.
  virtual bool is_gone() const noexcept = 0;
};

inline constexpr std::size_t kTransferBytes = 64;  // the most that the chip sends at once
inline constexpr std::size_t kStatusBytes = 2;     // of the serial chip, before what a transfer carries

}  // namespace myotact::device::falcon
