#include "haptics/force_parts.h"

namespace myotact::haptics {

namespace {

Vec3 or_zero(const Vec3& force_N) {
  return force_N.allFinite() ? force_N : Vec3(Vec3::Zero());
}

static_assert(kEffectCount == 5, "say here in which part of ForceParts the force of a new effect is shown");

template <class Effect>
const Vec3& wanted_N(const TickForces& tick) {
  return tick.wanted[place_of<Effect>()].force_N;
}

}  // namespace

messages::ForceParts force_parts(const TickForces& tick) noexcept {
  const Vec3 touch_N = or_zero(wanted_N<ContactEffect>(tick));
  const bool has_normal = tick.contact_normal.squaredNorm() > 0.0;
  // Without a surface's normal, a force out of reported contacts: they have no friction.
  const Vec3 across_N = has_normal ? Vec3(touch_N.dot(tick.contact_normal) * tick.contact_normal) : touch_N;
  const Vec3 along_N = touch_N - across_N;
  const Vec3 passed_N = or_zero(tick.passed_lines_N);
  const Vec3 texture_N = or_zero(wanted_N<TextureEffect>(tick) - passed_N);
  const Vec3 line_N = or_zero(wanted_N<LineEffect>(tick)) + passed_N;
  const Vec3 bone_N = or_zero(wanted_N<BoneEffect>(tick));
  const Vec3 tether_N = or_zero(wanted_N<TetherEffect>(tick));
  const Vec3 damping_N = or_zero(tick.ports_change_N + tick.gate_damping_N);
  const Vec3 asked_N = across_N + along_N + texture_N + line_N + bone_N + tether_N + damping_N;
  return {to_array(across_N), to_array(along_N),  to_array(texture_N), to_array(line_N),
          to_array(bone_N),   to_array(tether_N), to_array(damping_N), to_array(tick.sent_N - asked_N)};
}

}  // namespace myotact::haptics
