#pragma once

#include <vector>

#include "measure/fidelity/device_run.h"
#include "measure/fidelity/force_comparison.h"

namespace myotact::measure {

// What the hand did in a tick.
inline bool holds_line(const haptics::HapticTick& tick) {
  return tick.tool.grabbed_line >= 0;
}
inline bool holds_bone(const haptics::HapticTick& tick) {
  return tick.tool.grabbed_body >= 0;
}
inline bool holds_contact(const haptics::HapticTick& tick) {
  return tick.tool.contact.surface >= 0 && !holds_line(tick) && !holds_bone(tick);
}

/// Which ticks are compared with the true force, and why the others are not.
struct ComparedTicks {
  std::vector<bool> compared;  // one a tick
  std::size_t gate = 0;        // the force gate was opening, shut or fading
  std::size_t hand = 0;        // a hand was closing or opening, whose force rises and dies out over 100 ms
  std::size_t at_limit = 0;    // the true force is more than the device may give
};
/// One a tick of `true_N`, which may be fewer than the run has.
ComparedTicks compared_ticks(const scene::Scene& scene, const DeviceRun& run, const device::DeviceProfile& profile,
                             const std::vector<Vec3>& true_N);

/// The force that the run commanded beside the true one, for compare_forces().
ForceSeries felt_series(const DeviceRun& run, const std::vector<Vec3>& true_N, const std::vector<bool>& compared);

}  // namespace myotact::measure
