#pragma once

#include <cstdint>
#include <variant>

#include "haptics/effects/bone_drag.h"
#include "haptics/effects/effect.h"
#include "haptics/effects/pulling_method.h"
#include "haptics/haptic_settings.h"
#include "messages/tool_state.h"

namespace myotact::haptics {

/// A point of a bone in hand, while the bone button is down, by BoneDrag or by the published spring (PullingMethod).
/// Its port knows a spring between the hand and the point, which moves. Real-time safe; one thread.
class BoneEffect {
 public:
  BoneEffect(const HapticSettings& settings, const device::DeviceProfile& profile);

  EffectTick tick(const HandTick& hand, EffectNotes& notes) noexcept;
  void report(messages::ToolState& tool) const noexcept;

 private:
  PortTick port(const HandTick& hand, const Vec3& force_N) noexcept;

  /// The bone in hand, whichever method holds it.
  struct Held {
    std::int32_t body = -1;
    std::array<double, 3> point_rest_m{};
    double gain = 0.0;
    double stiffness_N_m = 0.0;    // of the simulation's spring, unscaled
    Vec3 target_m = Vec3::Zero();  // where that spring pulls the point; world
  };

  double force_scale_;  // felt over simulated force
  std::variant<BoneDrag, PullingMethod> method_;
  Held held_;
  // Of the last tick, as the port knows it
  std::int32_t body_ = -1;
  Vec3 point_m_ = Vec3::Zero();
  double stiffness_N_m_ = 0.0;    // felt
  Vec3 offset_m_ = Vec3::Zero();  // from point to hand when it closed
};

}  // namespace myotact::haptics
