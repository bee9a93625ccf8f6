#pragma once

#include <variant>

#include "haptics/effects/effect.h"
#include "haptics/effects/proxy_touch.h"
#include "haptics/effects/reported_touch.h"
#include "haptics/gate/buzz_detector.h"
#include "haptics/haptic_settings.h"
#include "messages/tool_state.h"

namespace myotact::haptics {

/// Touch: the force of surfaces on the tool, by the proxy or by a published method. It is softened while the tool
/// buzzes, while the simulation's answer is old, and by what the hand closes on a bone. Its port knows a spring between
/// hand and surface, carried by the tissue. Real-time safe; one thread.
class ContactEffect {
 public:
  ContactEffect(const HapticSettings& settings, const device::DeviceProfile& profile);

  /// Another tool from the next tick on, of which nothing is sent yet. What its spring stores then, and until a hand
  /// that no force holds has come to rest, is found there: no hand put it in. What the last one held is gone.
  void change_tool(double radius_m) noexcept;
  EffectTick tick(const HandTick& hand, EffectNotes& notes) noexcept;
  /// The proxy's place, and the contact with the spring that the simulation adds to its solve.
  void report(messages::ToolState& tool) const noexcept;

 private:
  std::uint32_t soften(const HandTick& hand) noexcept;
  void find_stored(PortTick& port, double dt_s) noexcept;

  double force_scale_;  // felt over simulated force
  double stiffness_N_m_;
  bool limit_stiffness_;
  std::variant<ProxyTouch, ReportedTouch> method_;
  BuzzDetector buzz_;
  double age_share_ = 1.0;       // of the stiffness, that the age of the model leaves
  double share_ = 1.0;           // of the stiffness, in all
  double changing_s_ = 0.0;      // left of the time in which the hand comes to rest with another tool
  double stored_J_ = 0.0;        // found so far, felt
  Vec3 force_N_ = Vec3::Zero();  // on the hand in the last tick, before the force scale; world
};

}  // namespace myotact::haptics
