#pragma once

#include "haptics/effects/effect.h"
#include "haptics/effects/muscle_line_drag.h"
#include "haptics/haptic_settings.h"
#include "messages/tool_state.h"

namespace myotact::haptics {

/// A muscle line in hand, while the grab button is down. Its port knows the string by its potential: no bound on its
/// stiffness has used up the device's friction yet, as those of contact and bone have. Real-time safe; one thread.
class LineEffect {
 public:
  LineEffect(const HapticSettings& settings, const device::DeviceProfile& profile);

  EffectTick tick(const HandTick& hand, EffectNotes& notes) noexcept;
  void report(messages::ToolState& tool) const noexcept;

 private:
  PortTick port(const HandTick& hand, const Vec3& force_N) noexcept;

  double force_scale_;  // felt over simulated force
  MuscleLineDrag line_;
  // Of the last tick
  messages::LocalLine held_;  // muscle -1: none
  double gain_ = 0.0;         // force scale times how far the hand has closed
  double stored_J_ = 0.0;
  Vec3 force_N_ = Vec3::Zero();
};

/// Energy in the string of a line in hand, unscaled, against the hand at `hand_m` (world) resting on its straight way
/// [J]. Real-time safe.
double string_energy_J(const messages::LocalLine& line, const Vec3& hand_m) noexcept;

}  // namespace myotact::haptics
