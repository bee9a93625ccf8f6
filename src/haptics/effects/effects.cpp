#include "haptics/effects/effects.h"

namespace myotact::haptics {

namespace {

template <class... Each>
std::tuple<Each...> made(const std::tuple<Each...>* /*list*/, const HapticSettings& settings,
                         const device::DeviceProfile& profile) {
  return {Each(settings, profile)...};
}

}  // namespace

Effects::Effects(const HapticSettings& settings, const device::DeviceProfile& profile)
    : effects_(made(static_cast<const EffectList*>(nullptr), settings, profile)) {}

const EffectTicks& Effects::tick(const HandTick& hand) noexcept {
  ticks_[place_of<BoneEffect>()] = std::get<BoneEffect>(effects_).tick(hand, notes_);
  const auto tick_other = [&]<class Effect>(Effect& effect) {
    if constexpr (!std::is_same_v<Effect, BoneEffect>) ticks_[place_of<Effect>()] = effect.tick(hand, notes_);
  };
  std::apply([&](auto&... effects) { (tick_other(effects), ...); }, effects_);
  return ticks_;
}

void Effects::report(messages::ToolState& tool) const noexcept {
  std::apply([&](const auto&... effects) { (effects.report(tool), ...); }, effects_);
}

}  // namespace myotact::haptics
