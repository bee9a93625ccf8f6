#pragma once

#include <array>
#include <cstddef>
#include <tuple>
#include <type_traits>

#include "haptics/effects/bone_effect.h"
#include "haptics/effects/contact_effect.h"
#include "haptics/effects/effect.h"
#include "haptics/effects/line_effect.h"
#include "haptics/effects/tether_effect.h"
#include "haptics/effects/texture_effect.h"
#include "messages/tool_state.h"

namespace myotact::haptics {

/// All that a hand feels. A new effect is a class of its own in this folder and one line here; README.md says what it
/// must have. In this order effects are computed (BoneEffect alone comes before all, since a hand that holds a bone
/// presses on nothing), added up, and may claim the damping that the device supports.
using EffectList = std::tuple<  //
    ContactEffect,              // touch: proxy or a published method by reports
    TextureEffect,              // relief, vibration and knock of the touched tissue; muscle lines under an open hand
    LineEffect,                 // a muscle line in hand
    BoneEffect,                 // a bone in hand: BoneDrag or the published spring
    TetherEffect>;              // a spring to a place of the scene

inline constexpr std::size_t kEffectCount = std::tuple_size_v<EffectList>;

/// What the effects of a tick answered, in the order of the list.
using EffectTicks = std::array<EffectTick, kEffectCount>;

/// The place of an effect in the list.
template <class Effect, std::size_t I = 0>
constexpr std::size_t place_of() {
  if constexpr (std::is_same_v<Effect, std::tuple_element_t<I, EffectList>>) {
    return I;
  } else {
    return place_of<Effect, I + 1>();
  }
}

/// The effects of one hand. Real-time safe but for the constructor; one thread.
class Effects {
 public:
  /// `settings` as the device supports them. Allocates.
  Effects(const HapticSettings& settings, const device::DeviceProfile& profile);

  /// Another tool touches from the next tick on; what is in hand stays there. Real-time safe.
  void change_tool(double radius_m) noexcept { std::get<ContactEffect>(effects_).change_tool(radius_m); }
  /// Once a tick in which the device's numbers are finite.
  const EffectTicks& tick(const HandTick& hand) noexcept;
  /// Writes what the simulation must know of the last tick into `tool`, whose other members stay.
  void report(messages::ToolState& tool) const noexcept;
  /// What the effects passed to each other in the last tick.
  const EffectNotes& notes() const noexcept { return notes_; }

 private:
  EffectList effects_;
  EffectNotes notes_;
  EffectTicks ticks_{};
};

}  // namespace myotact::haptics
