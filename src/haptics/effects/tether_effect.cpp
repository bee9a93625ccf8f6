#include "haptics/effects/tether_effect.h"

#include <algorithm>
#include <limits>

#include "haptics/gate/stiffness_bound.h"

namespace myotact::haptics {

TetherEffect::TetherEffect(const HapticSettings& settings, const device::DeviceProfile& profile)
    : force_scale_(settings.force_scale),
      stiffest_N_m_(settings.limit_stiffness ? stiffness_bound(profile).smallest_N_m()
                                             : std::numeric_limits<double>::infinity()) {}

EffectTick TetherEffect::tick(const HandTick& hand, EffectNotes& /*notes*/) noexcept {
  const TetherSpring now = spring(hand);
  EffectTick tick;
  tick.force_N = now.force_N(hand.hand.position_m);
  tick.port = port(hand, now, tick.force_N);
  return tick;
}

TetherSpring TetherEffect::spring(const HandTick& hand) const noexcept {
  if (hand.model == nullptr || !(hand.model->tether.stiffness_N_m > 0.0)) return {};
  const double wanted_N_m = force_scale_ * hand.model->tether.stiffness_N_m;
  return {tether_anchor_m(*hand.model, hand.now_ns), std::min(wanted_N_m, stiffest_N_m_), hand.limit_N};
}

/// First the hand moves, then the anchor. What the second does to the spring's energy is work on its end: the port
/// knows it as force times motion, and is credited with what a finite motion adds to that.
PortTick TetherEffect::port(const HandTick& hand, const TetherSpring& now, const Vec3& force_N) noexcept {
  const Vec3& hand_m = hand.hand.position_m;
  PortTick port;
  port.stored_J = now.energy_J(hand_m);
  const double kept_J = spring_.energy_J(hand_m);
  port.spring_gave_J = stored_J_ - kept_J;
  port.reports_potential = true;
  TetherSpring moved = spring_;
  if (moved.stiffness_N_m > 0.0) {
    moved.anchor_m = now.anchor_m;
    port.environment_moved_m = moved.anchor_m - spring_.anchor_m;
  }
  const double moved_J = moved.energy_J(hand_m);
  port.credit_J = moved_J - kept_J - force_N_.dot(port.environment_moved_m);
  port.found_J = std::max(0.0, port.stored_J - moved_J);
  port.opens = now.stiffness_N_m < spring_.stiffness_N_m;
  spring_ = now;
  force_N_ = force_N;
  stored_J_ = port.stored_J;
  return port;
}

}  // namespace myotact::haptics
