#include "haptics/haptic_ports.h"

#include <algorithm>
#include <cmath>

namespace myotact::haptics {

namespace {

/// Added damping b is stable in a loop of period T on a mass m below about m / T; this keeps well away (reference 2.6).
constexpr double kDampingShare = 0.4;
/// What vibration and knocks may give to a hand while there is contact. Friction of a slide takes a hundred times as
/// much (0.3 N at 0.1 m/s: 30 mW), which is where a real vibration has it from.
constexpr double kTextureGives_W = 3e-4;
constexpr double kNoForce_N = 1e-6;
/// A hand at rest between two counts of the encoder is read as moving by one of them on each axis, sqrt(3) at most: at
/// 20 um a count that is 35 mm/s, whose damping would be a force of its own. Not more: with two counts an hour of
/// poking gave a hand 2.7 mJ in one touch, with this 0.3 mJ.
constexpr double kUnclearCounts = 1.75;

/// Energy of a spring of stiffness k that is stretched by `stretch_m` and gives `force_N`; beyond F / k its force was
/// cut, and comes back over that way as it went.
double spring_energy_J(double force_N, double stiffness_N_m, double stretch_m) {
  if (!(stiffness_N_m > 0.0)) return 0.0;
  const double linear_m = force_N / stiffness_N_m;
  return force_N * (std::max(stretch_m, linear_m) - 0.5 * linear_m);
}

/// What the device's own friction takes from a motion [J].
double friction_J(const device::DeviceProfile& profile, double moved_m, double dt_s) {
  return (profile.coulomb_N + profile.viscous_Ns_m * moved_m / dt_s) * moved_m;
}

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

HapticPorts::HapticPorts(const device::DeviceProfile& profile, const PortSettings& settings)
    : profile_(profile),
      damping_share_(kDampingShare / (1 + std::max(0, profile.delay_ticks))),
      contact_(settings),
      texture_(settings),
      line_(settings),
      bone_(settings),
      tether_(settings) {}

/// A hand that closes on a taut line, or on the move, finds energy in it that nobody here put in.
void HapticPorts::find(EnergyPort& port, double energy_J) noexcept {
  port.credit(energy_J);
  found_J_ += energy_J;
}

PortTick HapticPorts::contact_tick(const PortsTick& tick) const noexcept {
  PortTick port;
  port.wanted_N = tick.wanted.contact_N;
  port.environment_moved_m = tick.tissue_moved_m;
  port.opens = !(tick.contact_stiffness_N_m > 0.0);  // what friction took pays for no later touch
  port.stored_J =
      spring_energy_J(port.wanted_N.norm(), tick.contact_stiffness_N_m, (tick.proxy_m - tick.hand_m).norm());
  return port;
}

/// A hand that presses puts a spring's energy into the relief too: the contact's, of which the relief is the small part
/// that depends on the place.
PortTick HapticPorts::texture_tick(const PortsTick& tick) noexcept {
  PortTick port;
  port.wanted_N = tick.wanted.texture_N;
  port.environment_moved_m = tick.tissue_moved_m;
  port.stored_J = tick.texture_held_J;
  texture_.credit(tick.texture_held_J - texture_held_J_);
  if (tick.contact_stiffness_N_m > 0.0) texture_.credit(kTextureGives_W * tick.dt_s);
  texture_held_J_ = tick.texture_held_J;
  return port;
}

/// A muscle that changes its tension under a hand at rest changes the string's energy by U; per force, that is a motion
/// of the string's own end.
PortTick HapticPorts::line_tick(const PortsTick& tick) noexcept {
  PortTick port;
  port.wanted_N = tick.wanted.line_N;
  const bool same = tick.line != nullptr && held_line_.muscle == tick.line->muscle;
  const messages::LocalLine& now = tick.line != nullptr ? *tick.line : held_line_;  // let go: the last one dies out
  const messages::LocalLine& before = same ? held_line_ : now;
  const double before_J = string_energy_J(before, tick.hand_m);
  const double now_J = string_energy_J(now, tick.hand_m);
  find(line_, std::max(0.0, tick.line_gain - line_gain_) * before_J);
  port.opens = tick.line_gain < line_gain_;
  const double held_N2 = line_wanted_N_.squaredNorm();
  if (same) {
    port.spring_gave_J = line_stored_J_ - line_gain_ * before_J;
    port.friction_J = friction_J(profile_, moved_m_.norm(), tick.dt_s);
  }
  if (same && held_N2 > kNoForce_N * kNoForce_N) {
    port.environment_moved_m = line_wanted_N_ * (tick.line_gain * (now_J - before_J) / held_N2);
  }
  line_wanted_N_ = port.wanted_N;
  line_stored_J_ = port.stored_J = tick.line_gain * now_J;
  line_gain_ = tick.line_gain;
  if (tick.line != nullptr) held_line_ = *tick.line;
  return port;
}

PortTick HapticPorts::bone_tick(const PortsTick& tick) noexcept {
  PortTick port;
  port.wanted_N = tick.wanted.bone_N;
  const double k = tick.body_stiffness_N_m;
  if (tick.body >= 0) {
    if (tick.body == body_) {
      port.environment_moved_m = tick.body_point_m - body_point_m_;
    } else {
      body_offset_m_ = tick.hand_m - tick.body_point_m;
    }
    body_point_m_ = tick.body_point_m;
    port.stored_J = spring_energy_J(port.wanted_N.norm(), k, (tick.hand_m - body_offset_m_ - body_point_m_).norm());
    if (k > body_stiffness_N_m_) find(bone_, (1.0 - body_stiffness_N_m_ / k) * port.stored_J);
    port.opens = k < body_stiffness_N_m_;
  }
  body_ = tick.body;
  body_stiffness_N_m_ = tick.body >= 0 ? k : 0.0;
  return port;
}

/// First the hand moves, then the anchor. What the second does to the spring's energy is work on its end: the port
/// knows it as force times motion, and is credited with what a finite motion adds to that.
PortTick HapticPorts::tether_tick(const PortsTick& tick) noexcept {
  PortTick port;
  port.wanted_N = tick.wanted.tether_N;
  port.stored_J = tick.tether.energy_J(tick.hand_m);
  const double kept_J = tether_spring_.energy_J(tick.hand_m);
  port.spring_gave_J = tether_stored_J_ - kept_J;
  port.friction_J = friction_J(profile_, moved_m_.norm(), tick.dt_s);
  TetherSpring moved = tether_spring_;
  if (moved.stiffness_N_m > 0.0) {
    moved.anchor_m = tick.tether.anchor_m;
    port.environment_moved_m = moved.anchor_m - tether_spring_.anchor_m;
  }
  const double moved_J = moved.energy_J(tick.hand_m);
  tether_.credit(moved_J - kept_J - tether_wanted_N_.dot(port.environment_moved_m));
  find(tether_, std::max(0.0, port.stored_J - moved_J));
  port.opens = tick.tether.stiffness_N_m < tether_spring_.stiffness_N_m;
  tether_spring_ = tick.tether;
  tether_wanted_N_ = port.wanted_N;
  tether_stored_J_ = port.stored_J;
  return port;
}

Vec3 HapticPorts::admit(EnergyPort& port, PortTick tick, const PortsTick& all) noexcept {
  tick.hand_moved_m = moved_m_;
  tick.dt_s = all.dt_s;
  tick.most_damping_Ns_m = damping_left_Ns_m_;
  tick.unclear_m = kUnclearCounts * profile_.resolution_m;
  const Vec3 asked_N = port.admit(tick);
  damping_left_Ns_m_ -= port.damping_Ns_m();
  return asked_N;
}

PortForces HapticPorts::admit(const PortsTick& tick) noexcept {
  moved_m_ = knows_hand_ ? Vec3(tick.hand_m - hand_m_) : Vec3::Zero();
  hand_m_ = tick.hand_m;
  knows_hand_ = true;
  damping_left_Ns_m_ = damping_share_ * profile_.inertia_kg / tick.dt_s;
  PortForces asked;
  asked.contact_N = admit(contact_, contact_tick(tick), tick);
  asked.texture_N = admit(texture_, texture_tick(tick), tick);
  asked.line_N = admit(line_, line_tick(tick), tick);
  asked.bone_N = admit(bone_, bone_tick(tick), tick);
  asked.tether_N = admit(tether_, tether_tick(tick), tick);
  asked_N_ = asked.sum_N();
  return asked;
}

void HapticPorts::book(const Vec3& sent_N) noexcept {
  const double asked_N2 = asked_N_.squaredNorm();
  const double share = asked_N2 > 0.0 ? std::clamp(sent_N.dot(asked_N_) / asked_N2, 0.0, 1.0) : 0.0;
  for (EnergyPort* port : {&contact_, &texture_, &line_, &bone_, &tether_}) port->book(share);
}

double HapticPorts::missing_J() const noexcept {
  return std::max(
      {contact_.missing_J(), texture_.missing_J(), line_.missing_J(), bone_.missing_J(), tether_.missing_J()});
}

double HapticPorts::damping_Ns_m() const noexcept {
  return contact_.damping_Ns_m() + texture_.damping_Ns_m() + line_.damping_Ns_m() + bone_.damping_Ns_m() +
         tether_.damping_Ns_m();
}

}  // namespace myotact::haptics
