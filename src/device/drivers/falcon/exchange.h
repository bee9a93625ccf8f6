#pragma once

#include <array>
#include <cstdint>

#include "core/vector.h"
#include "device/drivers/falcon/packet.h"
#include "device/exchanging_device.h"

namespace myotact::device::falcon {

struct ExchangeSettings {
  /// Motor counts for a newton metre of an arm. Not published: libnifalcon's authors tuned 10 000, captures of the
  /// maker's library fit 2300 .. 4700, the maker's peak force would need 18 000. Too low a scale only feels weak.
  double counts_per_Nm = 4000.0;
  double peak_force_N = 8.0;  // |force| that is ever converted into torque
};

/// One report in, one command out: where the grip is, whether that is to be believed, and what the motors may do.
///
///   report --take()--> counts homed, no jump, legs meet --> position, slopes --command()--> motor counts
///
/// Zero torque without all three legs homed, after 10 ms without a good report, for 100 ms after a leap of an encoder
/// or a homing, for legs that meet as no Falcon's do, for a force that is older than 20 ms or no number. An encoder
/// that lies without any of that is not found out. Real-time safe; one thread.
class Exchange {
 public:
  explicit Exchange(const ExchangeSettings& settings) : settings_(settings) {}

  void take(const Report& report, std::uint64_t now_ns) noexcept;
  Packet command(const WantedForce& wanted, std::uint64_t now_ns) const noexcept;

  DevicePhase phase(std::uint64_t now_ns) const noexcept;
  const Vec3& position_m() const noexcept { return position_m_; }      // from the middle of the workspace
  const Vec3& velocity_m_s() const noexcept { return velocity_m_s_; }  // low-passed
  /// When the report came that they are of; 0: none was good yet.
  std::uint64_t reported_ns() const noexcept { return reported_ns_; }
  std::uint8_t buttons() const noexcept { return buttons_; }
  std::uint64_t refused_reports() const noexcept { return refused_; }

 private:
  bool leaps(const Report& report, std::uint64_t now_ns) const noexcept;
  void refuse() noexcept;
  void place(const Vec3& grip_m, std::uint64_t now_ns) noexcept;

  ExchangeSettings settings_;
  std::array<std::int16_t, 3> counts_{};
  Vec3 position_m_ = Vec3::Zero(), velocity_m_s_ = Vec3::Zero();
  Mat3 angles_per_metre_ = Mat3::Identity();
  std::uint8_t buttons_ = 0;
  bool is_homed_ = false;   // in the newest report
  bool is_placed_ = false;  // position and slopes are of the newest report
  bool knows_counts_ = false;
  std::uint64_t distrusted_until_ns_ = 0;
  std::uint64_t heard_ns_ = 0;     // when the newest report came, good or not
  std::uint64_t reported_ns_ = 0;  // when the newest good report came; 0: never
  std::uint64_t refused_ = 0;
};

}  // namespace myotact::device::falcon
