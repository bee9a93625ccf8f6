#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/vector.h"
#include "device/device.h"
#include "haptics/gate/energy_port.h"

namespace myotact::haptics {

/// The hand of a tick, as the ports see it.
struct PortsHand {
  Vec3 position_m = Vec3::Zero();  // world
  double dt_s = 1e-3;              // > 0
};

/// One observer of energy for each effect, side by side: none can spend what another took. Together they damp no more
/// than the device supports; what one leaves of that is for those behind it. Real-time safe; one thread.
class HapticPorts {
 public:
  static constexpr std::size_t kMost = 8;

  explicit HapticPorts(const device::DeviceProfile& profile, const PortSettings& settings = {});

  /// The force to ask the gate for [N, world, felt]: the sum over the effects of what their ports admit. `ticks`: one
  /// an effect, 1 .. kMost, always in the same order; what the hand did, dt_s and what the device supports is filled in
  /// here.
  Vec3 admit(std::span<PortTick> ticks, const PortsHand& hand) noexcept;
  /// After the gate: what was sent for the sum of what was asked [N, world].
  void book(const Vec3& sent_N) noexcept;

  double damping_Ns_m() const noexcept;                 // added in the last tick, all ports
  double found_J() const noexcept { return found_J_; }  // stored in lines, grips, tethers and tools as they began
  double missing_J() const noexcept;                    // what came out and should not have, in the worst port
  const EnergyPort& port(std::size_t effect) const noexcept { return ports_[effect]; }

 private:
  device::DeviceProfile profile_;
  double damping_share_;
  std::array<EnergyPort, kMost> ports_;
  Vec3 hand_m_ = Vec3::Zero();
  bool knows_hand_ = false;
  double found_J_ = 0.0;
  Vec3 asked_N_ = Vec3::Zero();
};

}  // namespace myotact::haptics
