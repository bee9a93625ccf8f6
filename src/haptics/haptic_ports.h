#pragma once

#include <cstdint>

#include "core/vector.h"
#include "device/device.h"
#include "haptics/energy_port.h"
#include "haptics/tether.h"
#include "messages/local_model.h"

namespace myotact::haptics {

/// What the effects of a tick do to the hand, as felt (after the force scale).
struct PortForces {
  Vec3 contact_N = Vec3::Zero();
  Vec3 texture_N = Vec3::Zero();
  Vec3 line_N = Vec3::Zero();
  Vec3 bone_N = Vec3::Zero();
  Vec3 tether_N = Vec3::Zero();

  Vec3 sum_N() const { return contact_N + texture_N + line_N + bone_N + tether_N; }
};

/// What the ports must know of the tick beside the forces.
struct PortsTick {
  PortForces wanted;
  Vec3 hand_m = Vec3::Zero();
  double dt_s = 1e-3;                         // > 0
  Vec3 proxy_m = Vec3::Zero();                // of the contact
  Vec3 tissue_moved_m = Vec3::Zero();         // under it, in this tick
  double contact_stiffness_N_m = 0.0;         // felt; 0: none
  double texture_held_J = 0.0;                // the most that relief and passed lines may give back
  const messages::LocalLine* line = nullptr;  // in hand, as the newest model has it; null: none
  double line_gain = 0.0;                     // force scale times how far the hand has closed
  std::int32_t body = -1;                     // in hand
  Vec3 body_point_m = Vec3::Zero();           // its point in hand
  double body_stiffness_N_m = 0.0;            // of the grip, felt
  TetherSpring tether;
};

/// One observer of energy for each effect, side by side: none can spend what another took.
///
///   contact  spring between hand and proxy, carried by the tissue
///   texture  relief, vibration and knock on the tissue, and the lines that an open hand passes over
///   line     string to the ends of a muscle line; the muscle changes its tension. By its potential: no bound on its
///            stiffness has used up the device's friction yet, as those of contact and bone have
///   bone     spring between hand and a point of a bone, which moves
///   tether   spring between hand and a place of the scene, which moves. By its potential, as the line
///
/// Together they damp no more than the device bears. Real-time safe; one thread.
class HapticPorts {
 public:
  explicit HapticPorts(const device::DeviceProfile& profile, const PortSettings& settings = {});

  /// The forces to ask the gate for.
  PortForces admit(const PortsTick& tick) noexcept;
  /// After the gate: what was sent for the sum of what was asked [N].
  void book(const Vec3& sent_N) noexcept;

  double damping_Ns_m() const noexcept;                 // added in the last tick, all ports
  double found_J() const noexcept { return found_J_; }  // stored in lines, grips and tethers as they began, so far
  double missing_J() const noexcept;                    // what came out and should not have, in the worst port
  const EnergyPort& texture() const noexcept { return texture_; }

 private:
  void find(EnergyPort& port, double energy_J) noexcept;
  PortTick contact_tick(const PortsTick& tick) const noexcept;
  PortTick texture_tick(const PortsTick& tick) noexcept;
  PortTick line_tick(const PortsTick& tick) noexcept;
  PortTick bone_tick(const PortsTick& tick) noexcept;
  PortTick tether_tick(const PortsTick& tick) noexcept;
  Vec3 admit(EnergyPort& port, PortTick tick, const PortsTick& all) noexcept;

  device::DeviceProfile profile_;
  double damping_share_;
  EnergyPort contact_, texture_, line_, bone_, tether_;
  double texture_held_J_ = 0.0;
  Vec3 hand_m_ = Vec3::Zero();
  bool knows_hand_ = false;
  Vec3 moved_m_ = Vec3::Zero();     // the hand, in this tick
  double damping_left_Ns_m_ = 0.0;  // that the device still bears in this tick
  double found_J_ = 0.0;
  Vec3 asked_N_ = Vec3::Zero();
  messages::LocalLine held_line_;  // of the last tick; muscle -1: none
  double line_gain_ = 0.0;
  double line_stored_J_ = 0.0;  // of the last tick
  Vec3 line_wanted_N_ = Vec3::Zero();
  std::int32_t body_ = -1;
  Vec3 body_point_m_ = Vec3::Zero();
  double body_stiffness_N_m_ = 0.0;
  Vec3 body_offset_m_ = Vec3::Zero();  // from point to hand when it closed
  TetherSpring tether_spring_;         // of the last tick
  Vec3 tether_wanted_N_ = Vec3::Zero();
  double tether_stored_J_ = 0.0;
};

/// Energy in the string of a line in hand, unscaled, against the hand resting on its straight way [J].
double string_energy_J(const messages::LocalLine& line, const Vec3& hand_m) noexcept;

}  // namespace myotact::haptics
