#pragma once

#include "haptics/effects/effect.h"
#include "haptics/effects/tether.h"
#include "haptics/haptic_settings.h"
#include "messages/tool_state.h"

namespace myotact::haptics {

/// The spring to a place of the scene that a model asks for, as stiff as the device supports. Its port knows it by its
/// potential, as that of a muscle line. Real-time safe; one thread.
class TetherEffect {
 public:
  TetherEffect(const HapticSettings& settings, const device::DeviceProfile& profile);

  EffectTick tick(const HandTick& hand, EffectNotes& notes) noexcept;
  /// Nothing: the simulation has the other end of the spring itself.
  void report(messages::ToolState& tool) const noexcept { static_cast<void>(tool); }

 private:
  TetherSpring spring(const HandTick& hand) const noexcept;
  PortTick port(const HandTick& hand, const TetherSpring& now, const Vec3& force_N) noexcept;

  double force_scale_;   // felt over simulated force
  double stiffest_N_m_;  // that the device supports, felt
  // Of the last tick
  TetherSpring spring_;
  Vec3 force_N_ = Vec3::Zero();
  double stored_J_ = 0.0;
};

}  // namespace myotact::haptics
