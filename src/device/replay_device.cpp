#include "device/replay_device.h"

#include <utility>

namespace myotact::device {

ReplayDevice::ReplayDevice(std::vector<messages::DeviceState> states, const DeviceProfile& profile)
    : profile_(profile), states_(std::move(states)) {}

messages::DeviceState ReplayDevice::read(std::uint64_t now_ns) noexcept {
  if (std::exchange(previews_, false)) return states_.front();
  if (!finished()) return states_[next_++];
  messages::DeviceState held = states_.empty() ? messages::DeviceState{} : states_.back();
  held.stylus_velocity_world_m_s = {};
  held.sampled_at_ns = now_ns;
  return held;
}

}  // namespace myotact::device
