#include "haptics/gate/haptic_ports.h"

#include <algorithm>

namespace myotact::haptics {

namespace {

/// Added damping b, held over a tick T, takes b T / m of the speed of a mass m: beyond 1 it reverses the motion.
/// This keeps well away.
constexpr double kDampingShare = 0.4;
/// A hand at rest between two counts of the encoder is read as moving by one of them on each axis, sqrt(3) at most: at
/// 20 um a count that is 35 mm/s, whose damping would be a force of its own. Not more: with two counts an hour of
/// poking gave a hand 2.7 mJ in one touch, with this 0.3 mJ.
constexpr double kUnclearCounts = 1.75;

/// What the device's own friction takes from a motion [J].
double friction_J(const device::DeviceProfile& profile, double moved_m, double dt_s) {
  return (profile.coulomb_N + profile.viscous_Ns_m * moved_m / dt_s) * moved_m;
}

}  // namespace

HapticPorts::HapticPorts(const device::DeviceProfile& profile, const PortSettings& settings)
    : profile_(profile), damping_share_(kDampingShare / (1 + std::max(0, profile.delay_ticks))) {
  ports_.fill(EnergyPort(settings));
}

Vec3 HapticPorts::admit(std::span<PortTick> ticks, const PortsHand& hand) noexcept {
  const Vec3 moved_m = knows_hand_ ? Vec3(hand.position_m - hand_m_) : Vec3::Zero();
  hand_m_ = hand.position_m;
  knows_hand_ = true;
  double damping_left_Ns_m = damping_share_ * profile_.inertia_kg / hand.dt_s;
  for (std::size_t i = 0; i < std::min(ticks.size(), kMost); ++i) {
    PortTick& tick = ticks[i];
    tick.hand_moved_m = moved_m;
    tick.dt_s = hand.dt_s;
    tick.most_damping_Ns_m = damping_left_Ns_m;
    tick.unclear_m = kUnclearCounts * profile_.resolution_m;
    if (tick.reports_potential) tick.friction_J = friction_J(profile_, moved_m.norm(), hand.dt_s);
    found_J_ += tick.found_J;
    const Vec3 asked_N = ports_[i].admit(tick);
    damping_left_Ns_m -= ports_[i].damping_Ns_m();
    asked_N_ = i == 0 ? asked_N : Vec3(asked_N_ + asked_N);
  }
  return asked_N_;
}

void HapticPorts::book(const Vec3& sent_N) noexcept {
  const double asked_N2 = asked_N_.squaredNorm();
  const double share = asked_N2 > 0.0 ? std::clamp(sent_N.dot(asked_N_) / asked_N2, 0.0, 1.0) : 0.0;
  for (EnergyPort& port : ports_) port.book(share);
}

double HapticPorts::missing_J() const noexcept {
  double most_J = 0.0;
  for (const EnergyPort& port : ports_) most_J = std::max(most_J, port.missing_J());
  return most_J;
}

double HapticPorts::damping_Ns_m() const noexcept {
  double sum_Ns_m = 0.0;
  for (const EnergyPort& port : ports_) sum_Ns_m += port.damping_Ns_m();
  return sum_Ns_m;
}

}  // namespace myotact::haptics
