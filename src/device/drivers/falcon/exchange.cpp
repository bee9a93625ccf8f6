#include "device/drivers/falcon/exchange.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "device/drivers/falcon/kinematics.h"

namespace myotact::device::falcon {

namespace {

constexpr std::uint64_t kSilence_ns = 30'000'000;     // as the force gate takes a stale model
constexpr std::uint64_t kForceLife_ns = 20'000'000;   // twenty ticks: who asked for it has stopped ticking
constexpr std::uint64_t kReportLife_ns = 10'000'000;  // two exchanges without one: a force would answer an old position
constexpr std::uint64_t kDistrust_ns = 100'000'000;   // after a leap: many reports that agree
constexpr std::uint64_t kLongestGap_ns = 3'000'000;   // a longer one between reports excuses no further way
/// Counts that an arm can have: with the grip 0.075 .. 0.175 m out and up to 0.055 m off the axis they are -2507 ..
/// 2150, by the inverse kinematics.
constexpr int kFewestCounts = -2600, kMostCountsOfAnArm = 2250;
constexpr double kSamePose_rad = 1e-6;  // far above rounding, far below a count, 1 mrad
/// A hand moves the grip with 3 m/s at most; near the stops an arm makes a count of 0.021 mm: 140 counts a millisecond.
constexpr double kMostCountsPerMs = 200.0;
constexpr double kVelocityFilter_s = 5e-3;  // as of the simulated device
const Vec3 kMiddle_m(0.0, 0.0, 0.125);      // of the workspace, in the frame of the legs

bool are_of_arms(const std::array<std::int16_t, 3>& counts) {
  return std::all_of(counts.begin(), counts.end(),
                     [](std::int16_t count) { return count >= kFewestCounts && count <= kMostCountsOfAnArm; });
}

Angles angles_of_report(const Report& report) {
  Angles angles_rad{};
  for (std::size_t leg = 0; leg < 3; ++leg) angles_rad[leg] = angle_of_counts(report.encoder_counts[leg]);
  return angles_rad;
}

/// Where legs with these angles meet. Nothing: nowhere, or only in a way in which no Falcon is built, a leg folded
/// outwards, where the slopes have the wrong sign.
std::optional<Vec3> grip_as_built(const Angles& angles_rad) {
  const auto grip_m = grip_of(angles_rad);
  const auto built_rad = grip_m ? angles_of(*grip_m) : std::nullopt;
  if (!built_rad) return std::nullopt;
  for (std::size_t leg = 0; leg < 3; ++leg)
    if (std::abs((*built_rad)[leg] - angles_rad[leg]) > kSamePose_rad) return std::nullopt;
  return grip_m;
}

}  // namespace

bool Exchange::leaps(const Report& report, std::uint64_t now_ns) const noexcept {
  if (!knows_counts_) return false;
  const std::uint64_t since_ns = std::min(now_ns > heard_ns_ ? now_ns - heard_ns_ : 0, kLongestGap_ns);
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
  // Homing sets the counts anew, wherever the hand is: as a leap.
  const bool begins_anew = knows_counts_ && !is_homed_ && report.all_homed();
  if (begins_anew || leaps(report, now_ns)) distrusted_until_ns_ = now_ns + kDistrust_ns;
  counts_ = report.encoder_counts;
  knows_counts_ = true;
  heard_ns_ = now_ns;
  is_homed_ = report.all_homed();
  buttons_ = report.buttons;
  if (!is_homed_ || now_ns < distrusted_until_ns_ || !are_of_arms(counts_)) return refuse();
  const Angles angles_rad = angles_of_report(report);
  const auto grip_m = grip_as_built(angles_rad);
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
  const bool is_heard = now_ns < reported_ns_ || now_ns - reported_ns_ <= kReportLife_ns;
  if (phase(now_ns) != DevicePhase::Ready || !is_heard || !is_asked || !force_N.allFinite()) return encode(Command{});
  const double norm_N = force_N.norm();
  if (norm_N > settings_.peak_force_N) force_N *= settings_.peak_force_N / norm_N;
  const auto torque_Nm = torque_of(force_N, angles_per_metre_);
  if (!torque_Nm) return encode(Command{});
  return encode(Command{motor_counts(*torque_Nm, settings_.counts_per_Nm), true});
}

}  // namespace myotact::device::falcon
