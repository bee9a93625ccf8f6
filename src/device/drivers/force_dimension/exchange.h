#pragma once

#include <array>
#include <cstdint>

#include "core/vector.h"
#include "device/drivers/force_dimension/dhdapi.h"
#include "device/exchanging_device.h"

namespace myotact::device::force_dimension {

/// What the library reports in one exchange, in its frame: x towards the person, y to the right, z up [m, m/s].
struct RawState {
  int result = 0;  // the lowest of all answers: below zero, one failed
  Vec3 position_m = Vec3::Zero(), velocity_m_s = Vec3::Zero();
  unsigned int buttons = 0;
};

/// What is asked for now and then.
struct RawStatus {
  bool is_powered = true, is_connected = true, is_initialised = true, force_is_on = true;
  int force_off_cause = kNoCause;
};

/// What of an exchange is to be believed, and which force is allowed: none from a device that failed, stopped its
/// motors, does not know where it is or leapt, none for a force that is older than 20 ms or no number. Pure, on the
/// clock that it is given.
class Exchange {
 public:
  explicit Exchange(double peak_force_N) : peak_force_N_(peak_force_N) {}

  void take(const RawState& state, std::uint64_t now_ns) noexcept;
  void take(const RawStatus& status) noexcept { status_ = status; }
  /// It did not take a force.
  void distrust(std::uint64_t now_ns) noexcept;
  /// In the library's frame.
  Vec3 allowed(const WantedForce& wanted, std::uint64_t now_ns) const noexcept;
  /// Whether its motors may be switched on again: they went off by a fast hand or a pause of ours, and the hand has
  /// been slow for a second.
  bool may_enable(std::uint64_t now_ns) const noexcept;

  DevicePhase phase() const noexcept { return phase_; }
  const char* hint() const noexcept { return hint_; }
  const messages::DeviceState& state() const noexcept { return state_; }
  std::uint64_t heard_ns() const noexcept { return heard_ns_; }  // the last exchange without an error; 0: never

 private:
  bool leaps(const Vec3& position_m, std::uint64_t now_ns) const noexcept;
  void validate(std::uint64_t now_ns) noexcept;

  double peak_force_N_;
  RawStatus status_;
  DevicePhase phase_ = DevicePhase::Opening;
  const char* hint_ = "";
  messages::DeviceState state_;
  Vec3 position_m_ = Vec3::Zero();
  std::uint64_t heard_ns_ = 0, distrusted_until_ns_ = 0, fast_ns_ = 0;
};

/// Between the library's frame and ours.
inline Vec3 device_from_library(const Vec3& v) {
  return {v.y(), v.z(), v.x()};
}
inline Vec3 library_from_device(const Vec3& v) {
  return {v.z(), v.x(), v.y()};
}

}  // namespace myotact::device::force_dimension
