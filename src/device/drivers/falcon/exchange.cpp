#include "device/drivers/falcon/exchange.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "device/drivers/falcon/kinematics.h"

namespace myotact::device::falcon {

namespace {

constexpr std::uint64_t kSilence_ns = 30'000'000;    // as a stale model: FORMATS, force gate
constexpr std::uint64_t kForceLife_ns = 20'000'000;  // twenty ticks: who asked for it has stopped ticking
constexpr std::uint64_t kDistrust_ns = 100'000'000;  // after a leap: many reports that agree
constexpr std::uint64_t kLongestGap_ns =
    3'000'000;  // where a hand may be after a longer one, nobody knows: that counts as a leap
/// A hand moves the grip with 3 m/s at most; near the stops an arm makes a count of 0.021 mm: 140 counts a millisecond.
constexpr double kMostCountsPerMs = 200.0;
constexpr double kVelocityFilter_s = 5e-3;  // as of the simulated device
const Vec3 kMiddle_m(0.0, 0.0, 0.125);      // of the workspace, in the frame of the legs

Angles angles_of_report(const Report& report) {
  Angles angles_rad{};
  for (std::size_t leg = 0; leg < 3; ++leg) angles_rad[leg] = angle_of_counts(report.encoder_counts[leg]);
  return angles_rad;
}

}  // namespace

bool Exchange::leaps(const Report& report, std::uint64_t now_ns) noexcept {
  if (!knows_counts_) return false;
  const std::uint64_t since_ns = std::min(now_ns > reported_ns_ ? now_ns - reported_ns_ : 0, kLongestGap_ns);
  const double most = kMostCountsPerMs * std::max(1.0, 1e-6 * static_cast<double>(since_ns));
  for (std::size_t leg = 0; leg < 3; ++leg)
    if (std::abs(report.encoder_counts[leg] - counts_[leg]) > most) return true;
  return false;
}

void Exchange::refuse() noexcept {
  ++refused_;
  is_placed_ = false;
  velocity_m_s_.setZero();
}

void Exchange::take(const Report& report, std::uint64_t now_ns) noexcept {
  const bool leaped = leaps(report, now_ns);
  const bool was_homed = is_homed_;
  counts_ = report.encoder_counts;
  knows_counts_ = true;
  is_homed_ = report.all_homed();
  buttons_ = report.buttons;
  // Homing sets the counts anew: that leap is no fault, but the pose before it was not the grip's.
  if (leaped && was_homed) distrusted_until_ns_ = now_ns + kDistrust_ns;
  if (!is_homed_ || now_ns < distrusted_until_ns_) return refuse();
  const Angles angles_rad = angles_of_report(report);
  const auto grip_m = grip_of(angles_rad);
  const auto slopes = grip_m ? angles_per_metre(*grip_m, angles_rad) : std::nullopt;
  if (!slopes) return refuse();
  angles_per_metre_ = *slopes;
  place(*grip_m - kMiddle_m, now_ns);
}

void Exchange::place(const Vec3& position_m, std::uint64_t now_ns) noexcept {
  const double dt_s = 1e-9 * static_cast<double>(now_ns > reported_ns_ ? now_ns - reported_ns_ : 0);
  if (is_placed_ && dt_s > 0.0)
    velocity_m_s_ += dt_s / (dt_s + kVelocityFilter_s) * ((position_m - position_m_) / dt_s - velocity_m_s_);
  position_m_ = position_m;
  is_placed_ = true;
  reported_ns_ = now_ns;
}

DevicePhase Exchange::phase(std::uint64_t now_ns) const noexcept {
  if (reported_ns_ == 0 && !knows_counts_) return DevicePhase::Opening;
  if (!is_homed_) return DevicePhase::NeedsCalibration;
  const bool is_fresh = now_ns < reported_ns_ || now_ns - reported_ns_ <= kSilence_ns;
  return is_placed_ && is_fresh ? DevicePhase::Ready : DevicePhase::Opening;
}

Packet Exchange::command(const WantedForce& wanted, std::uint64_t now_ns) const noexcept {
  const bool is_asked = wanted.at_ns != 0 && (now_ns < wanted.at_ns || now_ns - wanted.at_ns <= kForceLife_ns);
  Vec3 force_N = to_vec3(wanted.force_N);
  if (phase(now_ns) != DevicePhase::Ready || !is_asked || !force_N.allFinite()) return encode(Command{});
  const double norm_N = force_N.norm();
  if (norm_N > settings_.peak_force_N) force_N *= settings_.peak_force_N / norm_N;
  const auto torque_Nm = torque_of(force_N, angles_per_metre_);
  if (!torque_Nm) return encode(Command{});
  return encode(Command{motor_counts(*torque_Nm, settings_.counts_per_Nm), true});
}

}  // namespace myotact::device::falcon
