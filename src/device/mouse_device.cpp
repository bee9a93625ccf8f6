#include "device/mouse_device.h"

#include <cmath>

namespace myotact::device {

namespace {

constexpr double kSmoothing_s = 0.03;  // two frames of the window at 60 Hz: no steps between mouse events

}  // namespace

messages::DeviceState MouseDevice::read(std::uint64_t now_ns) noexcept {
  if (target_.fetch()) wanted_m_ = to_vec3(target_.front().position_world_m);
  messages::DeviceState state;
  if (last_ns_ != 0 && now_ns > last_ns_) {
    const double gap_s = static_cast<double>(now_ns - last_ns_) * 1e-9;
    const Vec3 motion = (1.0 - std::exp(-gap_s / kSmoothing_s)) * (wanted_m_ - position_m_);
    position_m_ += motion;
    state.stylus_velocity_world_m_s = to_array(motion / gap_s);
  }
  last_ns_ = now_ns;
  state.stylus_position_world_m = to_array(position_m_);
  state.sampled_at_ns = now_ns;
  state.buttons = target_.front().buttons;
  return state;
}

}  // namespace myotact::device
