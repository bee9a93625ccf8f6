#include "device/drivers/falcon/packet.h"

#include <algorithm>

#include "device/drivers/falcon/transport.h"
#include "messages/device.h"

namespace myotact::device::falcon {

namespace {

constexpr std::uint8_t kBegin = '<', kEnd = '>', kZero = 0x41;
constexpr std::size_t kNumbersAt = 1, kFlagsAt = 13, kUnknownAt = 14;
constexpr std::uint8_t kHoming = 0x01;      // in the flags of a command
constexpr std::uint8_t kButtons = 0x0f;     // in the flags of a report
constexpr std::uint8_t kFirstHomed = 0x10;  // of encoder 1; the next two follow

std::size_t place_of(std::size_t number) {
  return kNumbersAt + 4 * number;
}

void put(Packet& packet, std::size_t number, std::int16_t value) {
  const auto bits = static_cast<std::uint16_t>(value);
  for (std::size_t nibble = 0; nibble < 4; ++nibble)
    packet[place_of(number) + nibble] = static_cast<std::uint8_t>(kZero + ((bits >> (4 * nibble)) & 0xfu));
}

bool is_number(const Packet& packet, std::size_t number) {
  return std::all_of(packet.begin() + static_cast<std::ptrdiff_t>(place_of(number)),
                     packet.begin() + static_cast<std::ptrdiff_t>(place_of(number) + 4),
                     [](std::uint8_t byte) { return byte >= kZero && byte <= kZero + 0xf; });
}

std::int16_t get(const Packet& packet, std::size_t number) {
  unsigned bits = 0;
  for (std::size_t nibble = 0; nibble < 4; ++nibble)
    bits |= (static_cast<unsigned>(packet[place_of(number) + nibble] - kZero) & 0xfu) << (4 * nibble);
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(bits));
}

Packet framed() {
  Packet packet{};
  packet.front() = kBegin;
  packet.back() = kEnd;
  packet[kUnknownAt] = kZero;
  return packet;
}

}  // namespace

std::uint32_t stylus_buttons(std::uint8_t buttons) noexcept {
  const auto as = [&](std::uint8_t button, std::uint32_t meaning) { return (buttons & button) != 0 ? meaning : 0u; };
  return as(kCentre, messages::kGrabButton) | as(kPlus, messages::kGrabBoneButton) |
         as(kMinus, messages::kClutchButton) | as(kFront, messages::kStopButton);
}

Packet encode(const Command& command) noexcept {
  Packet packet = framed();
  for (std::size_t motor = 0; motor < 3; ++motor) {
    const int counts = std::clamp<int>(command.motor_counts[motor], -kMostCounts, kMostCounts);
    put(packet, motor, static_cast<std::int16_t>(counts));
  }
  packet[kFlagsAt] = static_cast<std::uint8_t>(kZero + (command.homes ? kHoming : 0));
  return packet;
}

Command decode_command(const Packet& packet) noexcept {
  Command command;
  for (std::size_t motor = 0; motor < 3; ++motor) command.motor_counts[motor] = get(packet, motor);
  command.homes = ((packet[kFlagsAt] - kZero) & kHoming) != 0;
  return command;
}

Packet encode(const Report& report) noexcept {
  Packet packet = framed();
  unsigned flags = report.buttons & kButtons;
  for (std::size_t k = 0; k < 3; ++k) {
    put(packet, k, report.encoder_counts[k]);
    if (report.is_homed[k]) flags |= static_cast<unsigned>(kFirstHomed) << k;
  }
  packet[kFlagsAt] = static_cast<std::uint8_t>(kZero + flags);
  return packet;
}

std::optional<Report> decode(const Packet& packet) noexcept {
  if (packet.front() != kBegin || packet.back() != kEnd) return std::nullopt;
  const int flags = packet[kFlagsAt] - kZero;
  if (flags < 0 || flags > 0x7f) return std::nullopt;
  Report report;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!is_number(packet, k)) return std::nullopt;
    report.encoder_counts[k] = get(packet, k);
    report.is_homed[k] = (flags & (kFirstHomed << k)) != 0;
  }
  report.buttons = static_cast<std::uint8_t>(flags & kButtons);
  return report;
}

void PacketReader::take_transfer(std::span<const std::uint8_t> transfer) noexcept {
  for (std::size_t i = kStatusBytes; i < transfer.size(); ++i) {
    if (count_ == kKept) {
      begin_ = (begin_ + 1) % kKept;
      --count_;
      ++skipped_;
    }
    bytes_[(begin_ + count_++) % kKept] = transfer[i];
  }
}

std::optional<Packet> PacketReader::next() noexcept {
  while (count_ >= kPacketBytes) {
    const auto at = [this](std::size_t i) { return bytes_[(begin_ + i) % kKept]; };
    const bool is_packet = at(0) == kBegin && at(kPacketBytes - 1) == kEnd;
    Packet packet{};
    for (std::size_t i = 0; i < kPacketBytes; ++i) packet[i] = at(i);
    const std::size_t used = is_packet ? kPacketBytes : 1;
    begin_ = (begin_ + used) % kKept;
    count_ -= used;
    if (is_packet) return packet;
    ++skipped_;
  }
  return std::nullopt;
}

}  // namespace myotact::device::falcon
