#pragma once

#include <variant>

#include "haptics/effects/effect.h"
#include "haptics/effects/reported_contact.h"
#include "haptics/effects/touch_tick.h"
#include "haptics/proxy/contact_settings.h"
#include "messages/tool_state.h"

namespace myotact::haptics {

/// Touch by what the engine reported (LocalModel::reported), by one of the published methods: a spring of the contact's
/// stiffness over the depenetration. The tool's sphere stands where the depenetration ends. Real-time safe; one thread.
class ReportedTouch {
 public:
  using Method = std::variant<PenetrationMethod, PlaneMethod>;

  ReportedTouch(const Method& method, const ContactSettings& settings);

  void resize(double radius_m) noexcept;

  /// `share`: 0 .. 1, how much of the stiffness is allowed.
  TouchTick tick(const HandTick& hand, double share) noexcept;
  /// Writes the sphere's place and, if `share` > 0, the contact that carries most, with the spring that has the
  /// opposite of what the hand feels (`force_N`, before the force scale).
  void report(const Vec3& force_N, double share, messages::ToolState& tool) const noexcept;

 private:
  double stiffness_N_m(double share) const noexcept { return share * settings_.stiffness_N_m; }

  ContactSettings settings_;
  Method method_;
  MovingSurface no_surface_;
  // Of the last tick
  Vec3 tool_m_ = Vec3::Zero();
  Depenetration depenetration_;
  messages::ReportedContact bearing_;  // of depenetration_.bearing
};

}  // namespace myotact::haptics
