#include "device/drivers/force_dimension/exchange.h"

#include <algorithm>
#include <cmath>

namespace myotact::device::force_dimension {

namespace {

constexpr std::uint64_t kForceLife_ns = 20'000'000;
constexpr std::uint64_t kDistrust_ns = 100'000'000;  // after an error or a leap
constexpr double kFasterThanHands_m_s = 5.0;         // of a position; a resting encoder's step is far below
constexpr double kLeap_m = 0.005;                    // shorter steps are noise of the clock, not of the position
constexpr double kSlow_m_s = 0.1;                    // of a hand that has settled
constexpr std::uint64_t kSettled_ns = 1'000'000'000;

/// The first, or the gripper, takes hold of a muscle, the second is the clutch, the third takes hold of a bone, the
/// fourth stops.
std::uint32_t buttons_of(unsigned int mask) {
  const auto as = [&](unsigned int bit, std::uint32_t meaning) { return (mask & bit) != 0 ? meaning : 0u; };
  return as(1, messages::kGrabButton) | as(2, messages::kClutchButton) | as(4, messages::kGrabBoneButton) |
         as(8, messages::kStopButton);
}

const char* off_hint(int cause) {
  switch (cause) {
    case kByButton:
      return "The forces are off: press the device's force button.";
    case kByVelocity:
      return "The hand was too fast and the motors went off: hold the grip still for a second.";
    case kByDeadMan:
      return "The forces are off: hold the grip as the device wants it held.";
    case kByCable:
      return "The cable was pulled: plug it in again.";
    default:
      return "The motors went off: hold the grip still for a second.";
  }
}

}  // namespace

bool Exchange::leaps(const Vec3& position_m, std::uint64_t now_ns) const noexcept {
  if (heard_ns_ == 0 || now_ns <= heard_ns_) return false;
  const double way_m = (position_m - position_m_).norm();
  return way_m > kLeap_m && way_m > kFasterThanHands_m_s * 1e-9 * static_cast<double>(now_ns - heard_ns_);
}

void Exchange::take(const RawState& raw, std::uint64_t now_ns) noexcept {
  if (raw.result < 0 || !raw.position_m.allFinite() || !raw.velocity_m_s.allFinite()) {
    distrusted_until_ns_ = now_ns + kDistrust_ns;
  } else {
    if (leaps(raw.position_m, now_ns)) distrusted_until_ns_ = now_ns + kDistrust_ns;
    position_m_ = raw.position_m;
    heard_ns_ = now_ns;
    if (!(raw.velocity_m_s.norm() < kSlow_m_s)) fast_ns_ = now_ns;
    state_.stylus_position_world_m = to_array(device_from_library(raw.position_m));
    state_.stylus_velocity_world_m_s = to_array(device_from_library(raw.velocity_m_s));
    state_.sampled_at_ns = now_ns;
    state_.buttons = buttons_of(raw.buttons);
  }
  validate(now_ns);
}

void Exchange::distrust(std::uint64_t now_ns) noexcept {
  distrusted_until_ns_ = now_ns + kDistrust_ns;
  validate(now_ns);
}

void Exchange::validate(std::uint64_t now_ns) noexcept {
  phase_ = DevicePhase::Lost;
  if (!status_.is_connected) {
    hint_ = "The device does not answer: see to its cable.";
  } else if (!status_.is_powered) {
    hint_ = "Switch the device on.";
  } else if (!status_.is_initialised) {
    phase_ = DevicePhase::NeedsCalibration;
    hint_ = "The device does not know where it is: calibrate it (myotact devices --calibrate).";
  } else if (now_ns < distrusted_until_ns_) {
    hint_ = "The device's answers are not to be believed for the moment.";
  } else if (!status_.force_is_on) {
    hint_ = off_hint(status_.force_off_cause);
  } else {
    phase_ = DevicePhase::Ready;
    hint_ = "";
  }
}

Vec3 Exchange::allowed(const WantedForce& wanted, std::uint64_t now_ns) const noexcept {
  const Vec3 force_N = to_vec3(wanted.force_N);
  const double size_N = force_N.norm();
  const bool is_old = wanted.at_ns == 0 || now_ns > wanted.at_ns + kForceLife_ns;
  if (phase_ != DevicePhase::Ready || is_old || !std::isfinite(size_N)) return Vec3::Zero();
  return library_from_device(size_N > peak_force_N_ ? Vec3(force_N * (peak_force_N_ / size_N)) : force_N);
}

bool Exchange::may_enable(std::uint64_t now_ns) const noexcept {
  const int cause = status_.force_off_cause;
  const bool by_itself = cause == kByVelocity || cause == kByWatchdog || cause == kBySoftware || cause == kNoCause;
  return !status_.force_is_on && status_.is_powered && status_.is_initialised && by_itself &&
         now_ns > std::max(fast_ns_, distrusted_until_ns_) + kSettled_ns;
}

}  // namespace myotact::device::force_dimension
