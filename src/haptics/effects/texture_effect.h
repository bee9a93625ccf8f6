#pragma once

#include "haptics/effects/effect.h"
#include "haptics/effects/line_snap.h"
#include "haptics/effects/texture.h"
#include "haptics/haptic_settings.h"
#include "messages/tool_state.h"

namespace myotact::haptics {

/// What a surface feels like as the tool goes over it: texture of the touched tissue, and muscle lines that an open
/// hand passes over. Both are potentials of the place, and their energy is watched in one port. Real-time safe; one
/// thread.
class TextureEffect {
 public:
  TextureEffect(const HapticSettings& settings, const device::DeviceProfile& profile);

  EffectTick tick(const HandTick& hand, EffectNotes& notes) noexcept;
  /// Nothing: it is for the hand only. The tissue feels the contact's force, about which texture goes to and fro.
  void report(messages::ToolState& tool) const noexcept { static_cast<void>(tool); }

 private:
  PortTick port(const HandTick& hand, const Touch& touch) noexcept;

  double force_scale_;            // felt over simulated force
  double contact_stiffness_N_m_;  // of the coupling
  Texture texture_;
  LineSnap snap_;
  double held_J_ = 0.0;  // of the last tick: the most that relief and passed lines may give back, felt
};

}  // namespace myotact::haptics
