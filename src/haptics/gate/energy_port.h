#pragma once

#include "core/vector.h"

namespace myotact::haptics {

struct PortSettings {
  /// What a port may keep of the energy that friction and damping took: more would hide a later burst
  /// (own choice: the least of 5 to 20 mJ).
  double store_J = 5e-3;
  double leak_s = 1.0;  // time constant by which that surplus is forgotten
};

/// One tick of a port. All forces act on the hand.
struct PortTick {
  Vec3 wanted_N = Vec3::Zero();
  Vec3 hand_moved_m = Vec3::Zero();         // since the last tick
  Vec3 environment_moved_m = Vec3::Zero();  // of the port's other end by itself: tissue, point of a bone
  double stored_J = 0.0;                    // in the port's springs: what it may give back at any time, >= 0
  double spring_gave_J = 0.0;               // by their own potential, to the hand's motion; < 0: they took
  double friction_J = 0.0;                  // that the device's own friction took from that motion, >= 0
  bool reports_potential = false;           // spring_gave_J is valid: the device's friction may absorb force steps
  bool opens = false;                       // lets go of what it stores: nothing of it may be spent later
  double credit_J = 0.0;                    // energy that is accounted for elsewhere
  double allowance_J = 0.0;                 // that the effect may add without having received it, >= 0
  double found_J = 0.0;                     // stored in a spring before the hand closed on it, >= 0
  double most_damping_Ns_m = 0.0;           // that the device supports
  double unclear_m = 0.0;                   // a shorter way in a tick may be the encoder's rounding, not motion
  double dt_s = 1e-3;                       // > 0
};

/// Observer and controller of the energy that one effect (contact, texture, a line or bone in hand, a network) gives to
/// the hand: time-domain passivity (Hannaford and Ryu 2002), in two accounts:
///
///   hand o--/\/\--o environment       F: what was really sent, held over the tick that ends, so that sums are exact
///
///   coupling  E -= F . (dx_hand - dx_environment)            must not fall below 0
///             above `stored` it is what friction took: at most store_J, and it leaks
///   swing     S += F . dx_environment - F_slow . v_slow dt   must stay below 2 mJ; it leaks,
///             in 30 ms where the port opens
///
/// What is missing is taken back by damping, missing / (T v^2), no more than the device supports, in ticks whose way is
/// longer than the encoder's rounding.
///
/// A force held for a tick gives more on the way back than its spring holds, |dF dx| / 2 a tick, and so it seems, at
/// any speed, with a position that moves by whole counts of an encoder. As far as friction of the device itself takes
/// that in the same tick (the bound of Abbott and Okamura 2005) it never reaches the hand and is not missing: a spring
/// whose port reports its potential is then left alone. What friction leaves of it counts.
///
/// A muscle that shortens does real work on the hand, and that must not be taken for instability, nor may a budget for
/// it hide one. The two differ in their rate: limbs and tissue move of their own below some 5 Hz, a loop that goes
/// unstable through the simulation swings at 10 Hz and more. So work of the environment is free as far as it is the
/// product of the slow parts (30 ms) of force and motion: for a swing of 20 Hz that is 7 %. The slow parts come late:
/// that much (30 ms of slow work) may be missing, once and not in every swing. What is slower than that and still no
/// muscle is left to the gate, which watches the sum.
///
/// Real-time safe; one thread.
class EnergyPort {
 public:
  explicit EnergyPort(const PortSettings& settings = {}) : settings_(settings) {}

  /// The force to ask for in place of the wanted one.
  Vec3 admit(const PortTick& tick) noexcept;
  /// After the gate: which share (0 .. 1) of what was asked for the device got.
  void book(double share) noexcept { sent_N_ = share * asked_N_; }
  void reset() noexcept { *this = EnergyPort(settings_); }

  double energy_J() const noexcept { return energy_J_; }  // of the coupling
  /// What came out and should not have, by the account that lacks most, >= 0.
  double missing_J() const noexcept { return missing_J_; }
  double damping_Ns_m() const noexcept { return damping_Ns_m_; }  // added in the last tick

 private:
  PortSettings settings_;
  double energy_J_ = 0.0;
  double swing_J_ = 0.0;
  double missing_J_ = 0.0;
  double damping_Ns_m_ = 0.0;
  Vec3 asked_N_ = Vec3::Zero();
  Vec3 sent_N_ = Vec3::Zero();
  Vec3 slow_force_N_ = Vec3::Zero();
  Vec3 slow_environment_m_s_ = Vec3::Zero();
};

}  // namespace myotact::haptics
