#include "haptics/effects/bone_effect.h"

namespace myotact::haptics {

namespace {

std::variant<BoneDrag, PullingMethod> chosen(const HapticSettings& settings) {
  if (settings.method == ForceMethod::Pulling) {
    return PullingMethod({settings.bone.stiffness_N_m, settings.force_scale});
  }
  return BoneDrag(settings.bone);
}

Vec3 force_N_of(BoneDrag& method, const HandTick& hand, bool holds) noexcept {
  const BoneDrag::Tool tool{hand.hand.position_m, hand.hand.velocity_m_s, holds, hand.limit_N, hand.sequence};
  return method.tick(hand.model, hand.is_new, tool, hand.dt_s);
}

Vec3 force_N_of(PullingMethod& method, const HandTick& hand, bool holds) noexcept {
  return method.tick(hand.model, hand.hand.position_m, holds, hand.limit_N);
}

}  // namespace

BoneEffect::BoneEffect(const HapticSettings& settings, const device::DeviceProfile& /*profile*/)
    : force_scale_(settings.force_scale), method_(chosen(settings)) {}

EffectTick BoneEffect::tick(const HandTick& hand, EffectNotes& notes) noexcept {
  const bool holds = (hand.buttons & messages::kGrabBoneButton) != 0;
  EffectTick tick;
  std::visit(
      [&](auto& method) {
        tick.force_N = force_N_of(method, hand, holds);
        held_ = {method.body(), method.point_rest_m(), method.gain(), method.stiffness_N_m(), method.target_m()};
      },
      method_);
  notes.holds_bone = held_.body >= 0;
  notes.bone_gain = held_.gain;
  tick.port = port(hand, tick.force_N);
  return tick;
}

/// A hand that closes on the move finds energy in the spring.
PortTick BoneEffect::port(const HandTick& hand, const Vec3& force_N) noexcept {
  PortTick port;
  const double k = force_scale_ * held_.stiffness_N_m;
  Vec3 point_m = held_.target_m;
  if (k > 0.0) point_m += force_N / k;
  if (held_.body >= 0) {
    if (held_.body == body_) {
      port.environment_moved_m = point_m - point_m_;
    } else {
      offset_m_ = hand.hand.position_m - point_m;
    }
    point_m_ = point_m;
    port.stored_J = spring_energy_J(force_N.norm(), k, (hand.hand.position_m - offset_m_ - point_m_).norm());
    if (k > stiffness_N_m_) port.found_J = (1.0 - stiffness_N_m_ / k) * port.stored_J;
    port.opens = k < stiffness_N_m_;
  }
  body_ = held_.body;
  stiffness_N_m_ = held_.body >= 0 ? k : 0.0;
  return port;
}

void BoneEffect::report(messages::ToolState& tool) const noexcept {
  tool.grabbed_body = held_.body;
  tool.body_point_rest_m = held_.point_rest_m;
  tool.body_target_world_m = to_array(held_.target_m);
  tool.body_stiffness_N_m = held_.stiffness_N_m;
}

}  // namespace myotact::haptics
