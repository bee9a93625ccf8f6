#pragma once

#include "haptics/effects/contact_compliance.h"
#include "haptics/effects/effect.h"
#include "haptics/effects/touch_tick.h"
#include "haptics/proxy/contact_settings.h"
#include "haptics/proxy/moving_surface.h"
#include "haptics/proxy/proxy.h"
#include "messages/tool_state.h"

namespace myotact::haptics {

/// Force of the coupling spring (Colgate et al. 1995) on the hand [N, world], before the force scale, plus damping
/// while the tool goes into the tissue. The normal part never pulls into the tissue. Zero without contact. Real-time
/// safe.
Vec3 coupling_force_N(const Proxy& proxy, const ProxyGoal& device, const ContactSettings& settings) noexcept;

/// Touch by the proxy: a sphere kept outside of the surface as it is played between models, and the spring from it to
/// the hand, in a row with the tissue that gives way. Real-time safe; one thread.
class ProxyTouch {
 public:
  explicit ProxyTouch(const ContactSettings& settings);

  void resize(double radius_m) noexcept { proxy_.resize(radius_m); }

  /// `share`: 0 .. 1, how much of the stiffness is allowed.
  TouchTick tick(const HandTick& hand, double share) noexcept;
  /// Writes the proxy's place and, if `share` > 0, the contact. The spring pulls the touched point with the opposite of
  /// what the hand feels (`force_N`, before the force scale), as long as the tissue is where it is believed to be; its
  /// rest place follows the device.
  void report(const Vec3& force_N, double share, messages::ToolState& tool) const noexcept;

 private:
  double lead_share() const noexcept;  // of a step, by which the surface is played ahead
  Vec3 force_N(const HandTick& hand, double share) noexcept;
  std::uint32_t new_faults() noexcept;

  ContactSettings settings_;
  MovingSurface surface_;
  Proxy proxy_;
  ContactCompliance compliance_;
  ProxyCounters counted_;
};

}  // namespace myotact::haptics
