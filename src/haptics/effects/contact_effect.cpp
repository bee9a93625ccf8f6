#include "haptics/effects/contact_effect.h"

#include <algorithm>

#include "haptics/faults.h"
#include "haptics/gate/stiffness_bound.h"

namespace myotact::haptics {

namespace {

constexpr double kFelt_N = 0.02;    // less force than this moves no device: nothing can buzz
constexpr double kSoften_s = 0.02;  // a stiffness that is too much is gone before a second swing
constexpr double kStiffen_s = 0.5;  // and comes back without a push
/// A hand without force against it stands where it wants to be (own choice); by then the ramp sends a third.
constexpr double kComesToRest_s = 0.3;

std::variant<ProxyTouch, ReportedTouch> chosen(const HapticSettings& settings) {
  if (settings.method == ForceMethod::Penetration) return ReportedTouch(PenetrationMethod(), settings.contact);
  if (settings.method == ForceMethod::Plane) {
    return ReportedTouch(PlaneMethod(settings.contact.radius_m), settings.contact);
  }
  return ProxyTouch(settings.contact);
}

}  // namespace

ContactEffect::ContactEffect(const HapticSettings& settings, const device::DeviceProfile& profile)
    : force_scale_(settings.force_scale),
      stiffness_N_m_(settings.contact.stiffness_N_m),
      limit_stiffness_(settings.limit_stiffness),
      method_(chosen(settings)),
      buzz_(profile.resolution_m) {}

void ContactEffect::change_tool(double radius_m) noexcept {
  std::visit([&](auto& method) { method.resize(radius_m); }, method_);
  changing_s_ = kComesToRest_s;
  stored_J_ = 0.0;
}

EffectTick ContactEffect::tick(const HandTick& hand, EffectNotes& notes) noexcept {
  EffectTick tick;
  tick.faults = soften(hand);
  // A hand that holds the bone does not also press on it: two springs would be stiffer than the device supports.
  share_ = (1.0 - notes.bone_gain) * age_share_ * buzz_.stiffness_share();
  const TouchTick felt = std::visit([&](auto& method) { return method.tick(hand, share_); }, method_);
  force_N_ = felt.force_N;
  const double peak_N = hand.limit_N / force_scale_;  // the tissue feels no more than the hand
  if (force_N_.norm() > peak_N) force_N_ *= peak_N / force_N_.norm();
  tick.faults |= felt.faults;
  tick.force_N = force_scale_ * force_N_;
  const double stiffness_N_m = force_scale_ * felt.stiffness_N_m;
  tick.port.environment_moved_m = felt.end_moved_m;
  tick.port.opens = !(stiffness_N_m > 0.0);  // what friction took pays for no later touch
  tick.port.stored_J = spring_energy_J(tick.force_N.norm(), stiffness_N_m, (felt.end_m - hand.hand.position_m).norm());
  find_stored(tick.port, hand.dt_s);
  notes.touch = {felt.surface, felt.contact, force_N_, felt.end_moved_m, stiffness_N_m > 0.0};
  return tick;
}

/// A hand sinks in as the old tool's force fades out, against nothing; the ramp then lifts it out again.
void ContactEffect::find_stored(PortTick& port, double dt_s) noexcept {
  if (changing_s_ <= 0.0) return;
  changing_s_ -= dt_s;
  port.found_J = std::max(0.0, port.stored_J - stored_J_);
  stored_J_ = port.stored_J;
  port.opens = true;  // no surplus is kept of what is counted twice
}

std::uint32_t ContactEffect::soften(const HandTick& hand) noexcept {
  std::uint32_t faults = 0;
  if (buzz_.tick(hand.hand.position_m, hand.sent_N > kFelt_N, hand.dt_s)) faults |= bit(Fault::Buzz);
  if (hand.model == nullptr || !limit_stiffness_) return faults;
  const double age_s = std::max(1e-3, hand.model_age_s);
  const double allowed = std::min(1.0, stiffness_by_age_N_m(age_s) / stiffness_N_m_);
  age_share_ += std::min(1.0, hand.dt_s / (allowed < age_share_ ? kSoften_s : kStiffen_s)) * (allowed - age_share_);
  if (allowed < 1.0) faults |= bit(Fault::StiffnessLowered);
  return faults;
}

void ContactEffect::report(messages::ToolState& tool) const noexcept {
  tool.contact = {};
  tool.beside = {};
  tool.touched_world_m = {};
  std::visit([&](const auto& method) { method.report(force_N_, share_, tool); }, method_);
}

}  // namespace myotact::haptics
