#include "haptics/haptic_group.h"

namespace myotact::haptics {

void share_stop(const HapticLoop& ticked, std::span<HapticLoop* const> group) noexcept {
  if ((ticked.last_tick().device.buttons & messages::kStopButton) != 0) stop_forces(group, true);
}

void tick_all(std::span<HapticLoop* const> group, std::uint64_t now_ns) noexcept {
  for (HapticLoop* loop : group) {
    loop->tick(now_ns);
    share_stop(*loop, group);
  }
}

void stop_forces(std::span<HapticLoop* const> group, bool stopped) noexcept {
  for (HapticLoop* loop : group) loop->stop_forces(stopped);
}

}  // namespace myotact::haptics
