#include "fake_falcon.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "device/drivers/falcon/kinematics.h"

namespace myotact::device::falcon {

namespace {

constexpr std::uint8_t kBaudRequest = 3;
constexpr std::uint16_t kGreetingBaud = 0x4138, kUploadBaud = 0x0015, kNormalBaud = 0x0002;
constexpr std::size_t kSmallestImage = 7000;

}  // namespace

bool FakeFalcon::request(std::uint8_t number, std::uint16_t value) noexcept {
  if (is_gone()) return false;
  if (number != kBaudRequest) return true;
  baud_ = value;
  if (baud_ == kGreetingBaud) {  // the processor starts anew
    runs_ = was_greeted_ = false;
    uploaded_.clear();
    blocks_ = 0;
  }
  if (baud_ == kNormalBaud && uploaded_.size() >= kSmallestImage) runs_ = true;
  return true;
}

void FakeFalcon::answer(std::vector<std::uint8_t> payload) {
  payload.insert(payload.begin(), {0x01, 0x60});
  to_host_.push_back(std::move(payload));
}

void FakeFalcon::take_upload(std::span<const std::uint8_t> bytes) {
  std::vector<std::uint8_t> echo(bytes.begin(), bytes.end());
  if (blocks_ > 0) uploaded_.insert(uploaded_.end(), bytes.begin(), bytes.end());  // the first is the one byte before
  if (blocks_++ == spoiled_block_) {
    echo.back() = static_cast<std::uint8_t>(echo.back() ^ 1u);
    spoiled_block_ = -1;
  }
  answer({echo.begin(), echo.begin() + static_cast<std::ptrdiff_t>(echo.size() / 2)});  // in two transfers, as it may
  answer({echo.begin() + static_cast<std::ptrdiff_t>(echo.size() / 2), echo.end()});
}

Report FakeFalcon::report() const {
  Report report;
  const auto angles_rad = angles_of(grip_m_);
  for (std::size_t leg = 0; leg < 3 && angles_rad; ++leg)
    report.encoder_counts[leg] = static_cast<std::int16_t>(std::lround(counts_of_angle((*angles_rad)[leg])));
  report.is_homed.fill(was_at_stops_ && last_.homes);
  report.buttons = buttons_;
  if (fault_ == Fault::HomedDrops) report.is_homed[1] = false;
  if (fault_ == Fault::EncoderLeaps)
    report.encoder_counts[0] = static_cast<std::int16_t>(report.encoder_counts[0] + 900);
  return report;
}

void FakeFalcon::answer_command(const Packet& packet) {
  last_ = decode_command(packet);
  ++commands_;
  const Packet bytes = encode(report());
  const std::vector<std::uint8_t> whole(bytes.begin(), bytes.end());
  switch (fault_) {
    case Fault::NoReply:
    case Fault::Stall:
      return;
    case Fault::StatusOnly:
      return answer({});
    case Fault::Split:
      answer({whole.begin(), whole.begin() + 5});
      return answer({whole.begin() + 5, whole.end()});
    case Fault::TwoAtOnce: {
      std::vector<std::uint8_t> two = whole;
      two.insert(two.end(), whole.begin(), whole.end());
      return answer(std::move(two));
    }
    case Fault::GarbageBefore: {
      std::vector<std::uint8_t> all = {'x', '<', 0xff};
      all.insert(all.end(), whole.begin(), whole.end());
      return answer(std::move(all));
    }
    default:
      return answer(whole);
  }
}

bool FakeFalcon::send(std::span<const std::uint8_t> bytes) noexcept {
  if (is_gone() || fault_ == Fault::Stall) return false;
  constexpr std::array<std::uint8_t, 3> kGreeting = {0x0a, 0x43, 0x0d};
  if (baud_ == kGreetingBaud) {
    if (!std::equal(bytes.begin(), bytes.end(), kGreeting.begin(), kGreeting.end())) return true;
    was_greeted_ = true;
    answer(greets_with_zero_ ? std::vector<std::uint8_t>{0, 0x0a, 0x44, 0x2c, 0x0d}
                             : std::vector<std::uint8_t>{0x0a, 0x44, 0x2c, 0x0d});
  } else if (baud_ == kUploadBaud && was_greeted_) {
    take_upload(bytes);
  } else if (runs_ && bytes.size() == kPacketBytes) {
    Packet packet{};
    std::copy(bytes.begin(), bytes.end(), packet.begin());
    answer_command(packet);
  }
  return true;
}

std::size_t FakeFalcon::receive(std::span<std::uint8_t> bytes, std::chrono::milliseconds patience) noexcept {
  if (to_host_.empty()) {
    now_ns_ += static_cast<std::uint64_t>(std::chrono::nanoseconds(patience).count());
    return 0;
  }
  now_ns_ += 500'000;
  const std::size_t count = std::min(bytes.size(), to_host_.front().size());
  std::copy_n(to_host_.front().begin(), count, bytes.begin());
  to_host_.pop_front();
  return count;
}

Vec3 FakeFalcon::force_N(double counts_per_Nm) const {
  const auto angles_rad = angles_of(grip_m_);
  const auto slopes = angles_rad ? angles_per_metre(grip_m_, *angles_rad) : std::nullopt;
  if (!slopes) return Vec3::Zero();
  Vec3 torque_Nm;
  for (std::size_t leg = 0; leg < 3; ++leg) torque_Nm[static_cast<int>(leg)] = -last_.motor_counts[leg] / counts_per_Nm;
  return slopes->transpose() * torque_Nm;
}

}  // namespace myotact::device::falcon
