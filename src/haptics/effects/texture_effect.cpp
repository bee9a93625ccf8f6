#include "haptics/effects/texture_effect.h"

#include <algorithm>

namespace myotact::haptics {

namespace {

/// What vibration and knocks may give to a hand while there is contact. Friction of a slide takes a hundred times as
/// much (0.3 N at 0.1 m/s: 30 mW), which is where a real vibration has it from.
constexpr double kTextureGives_W = 3e-4;

}  // namespace

TextureEffect::TextureEffect(const HapticSettings& settings, const device::DeviceProfile& /*profile*/)
    : force_scale_(settings.force_scale),
      contact_stiffness_N_m_(settings.contact.stiffness_N_m),
      texture_(settings.texture),
      snap_(settings.snap) {}

EffectTick TextureEffect::tick(const HandTick& hand, EffectNotes& notes) noexcept {
  const Touch& touch = notes.touch;
  const double normal_N = std::max(0.0, touch.force_N.dot(touch.contact.normal));
  EffectTick tick;
  tick.force_N = force_scale_ * texture_.tick_N(*touch.surface, touch.contact,
                                                {hand.hand, normal_N, contact_stiffness_N_m_, hand.dt_s});
  const messages::LocalLine nothing_near;
  const messages::LocalLine& line = hand.model == nullptr ? nothing_near : hand.model->line;
  const bool open = notes.line_gain <= 0.0 && !notes.holds_bone;
  notes.passed_lines_N = force_scale_ * snap_.tick(line, hand.hand.position_m, open, hand.dt_s);
  tick.force_N += notes.passed_lines_N;
  tick.port = port(hand, touch);
  return tick;
}

/// A hand that presses puts a spring's energy into the relief too: the contact's, of which the relief is the small part
/// that depends on the place.
PortTick TextureEffect::port(const HandTick& hand, const Touch& touch) noexcept {
  double held_J = force_scale_ * snap_.held_J();
  if (touch.contact.active) held_J += force_scale_ * texture_.held_J();
  PortTick port;
  port.environment_moved_m = touch.tissue_moved_m;
  port.stored_J = held_J;
  port.credit_J = held_J - held_J_;
  if (touch.presses) port.allowance_J = kTextureGives_W * hand.dt_s;
  held_J_ = held_J;
  return port;
}

}  // namespace myotact::haptics
