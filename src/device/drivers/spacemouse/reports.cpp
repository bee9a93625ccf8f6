#include "device/drivers/spacemouse/reports.h"

#include <algorithm>

#include "messages/device.h"

namespace myotact::device::spacemouse {

namespace {

constexpr std::size_t kAxesBytes = 6;  // three int16
constexpr std::size_t kSplitLength = 1 + kAxesBytes;
constexpr std::size_t kCombinedLength = 1 + 2 * kAxesBytes;

int axis_at(std::span<const std::uint8_t> report, std::size_t byte) {
  const auto bits = static_cast<std::uint16_t>(report[byte] | report[byte + 1] << 8);
  return std::clamp<int>(static_cast<std::int16_t>(bits), -kFullDeflection, kFullDeflection);
}

std::array<int, 3> axes_at(std::span<const std::uint8_t> report, std::size_t byte) {
  return {axis_at(report, byte), axis_at(report, byte + 2), axis_at(report, byte + 4)};
}

std::uint32_t keys_of(std::span<const std::uint8_t> report) {
  std::uint32_t keys = 0;
  for (std::size_t byte = 1; byte < std::min<std::size_t>(report.size(), 5); ++byte) {
    keys |= std::uint32_t{report[byte]} << (8 * (byte - 1));
  }
  return keys;
}

}  // namespace

bool apply_report(std::span<const std::uint8_t> report, Cap& cap) noexcept {
  if (report.size() < 2) return false;
  switch (report[0]) {
    case kPushReport:
      if (report.size() < kSplitLength) return false;
      cap.push = axes_at(report, 1);
      if (report.size() >= kCombinedLength) cap.rotation = axes_at(report, 1 + kAxesBytes);
      return true;
    case kRotationReport:
      if (report.size() < kSplitLength) return false;
      cap.rotation = axes_at(report, 1);
      return true;
    case kKeysReport:
      cap.keys = keys_of(report);
      return true;
    case kBatteryReport:
      cap.battery_percent = std::min<int>(report[1], 100);
      return true;
    default:
      return false;
  }
}

std::uint32_t stylus_buttons(std::uint32_t keys) noexcept {
  const auto down = [&](std::uint32_t mask) { return (keys & mask) != 0; };
  std::uint32_t buttons = 0;
  if (down(bit_of(Key::Menu) | bit_of(Key::One))) buttons |= messages::kGrabButton;
  if (down(bit_of(Key::Fit) | bit_of(Key::Two))) buttons |= messages::kGrabBoneButton;
  if (down(bit_of(Key::Escape))) buttons |= messages::kStopButton;
  return buttons;
}

}  // namespace myotact::device::spacemouse
