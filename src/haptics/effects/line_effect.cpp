#include "haptics/effects/line_effect.h"

#include <algorithm>

namespace myotact::haptics {

namespace {

constexpr double kNoForce_N = 1e-6;

}  // namespace

double string_energy_J(const messages::LocalLine& line, const Vec3& hand_m) noexcept {
  const Vec3 proximal_m = to_vec3(line.proximal_point_world_m);
  const Vec3 distal_m = to_vec3(line.distal_point_world_m);
  const double straight_m = (proximal_m - distal_m).norm();
  const double over_m = std::max(0.0, (proximal_m - hand_m).norm() + (distal_m - hand_m).norm() - straight_m);
  const double k = std::max(0.0, line.stiffness_N_m);
  const double tension_N = line.tension_N + k * (straight_m - line.length_m);  // when it is straight
  if (tension_N >= 0.0) return over_m * (tension_N + 0.5 * k * over_m);
  if (!(k > 0.0)) return 0.0;
  const double taut_m = std::max(0.0, over_m + tension_N / k);
  return 0.5 * k * taut_m * taut_m;
}

LineEffect::LineEffect(const HapticSettings& settings, const device::DeviceProfile& /*profile*/)
    : force_scale_(settings.force_scale), line_(settings.line) {}

EffectTick LineEffect::tick(const HandTick& hand, EffectNotes& notes) noexcept {
  const messages::LocalLine nothing_near;
  const messages::LocalLine& line = hand.model == nullptr ? nothing_near : hand.model->line;
  const bool holds = (hand.buttons & messages::kGrabButton) != 0;
  const Vec3 line_N = line_.tick(line, {hand.hand.position_m, hand.hand.velocity_m_s, holds}, hand.dt_s);
  notes.line_gain = line_.gain();
  notes.line_tension_N = line_.tension_N();
  EffectTick tick;
  tick.force_N = force_scale_ * line_N;
  tick.port = port(hand, tick.force_N);
  return tick;
}

/// A muscle that changes its tension under a hand at rest changes the string's energy by U; per force, that is a motion
/// of the string's own end. A hand that closes on a taut line finds energy in it.
PortTick LineEffect::port(const HandTick& hand, const Vec3& force_N) noexcept {
  PortTick port;
  const bool known = hand.model != nullptr && line_.muscle() >= 0 && hand.model->line.muscle == line_.muscle();
  const bool same = known && held_.muscle == hand.model->line.muscle;
  const messages::LocalLine& now = known ? hand.model->line : held_;  // let go: the last one dies out
  const messages::LocalLine& before = same ? held_ : now;
  const double gain = force_scale_ * line_.gain();
  const double before_J = string_energy_J(before, hand.hand.position_m);
  const double now_J = string_energy_J(now, hand.hand.position_m);
  port.found_J = std::max(0.0, gain - gain_) * before_J;
  port.opens = gain < gain_;
  const double held_N2 = force_N_.squaredNorm();
  if (same) {
    port.spring_gave_J = stored_J_ - gain_ * before_J;
    port.reports_potential = true;
  }
  if (same && held_N2 > kNoForce_N * kNoForce_N) {
    port.environment_moved_m = force_N_ * (gain * (now_J - before_J) / held_N2);
  }
  force_N_ = force_N;
  stored_J_ = port.stored_J = gain * now_J;
  gain_ = gain;
  if (known) held_ = hand.model->line;
  return port;
}

void LineEffect::report(messages::ToolState& tool) const noexcept {
  tool.grabbed_line = line_.muscle();
  tool.grab_fraction = line_.fraction();
  tool.line_stiffness_N_m = line_.muscle() >= 0 ? line_.grab_stiffness_N_m() : 0.0;
}

}  // namespace myotact::haptics
