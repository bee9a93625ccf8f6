#include "device/mouse_device.h"

#include <cmath>

namespace myotact::device {

namespace {

/// Two frames of a 60 Hz window: the jumps of the pointer become ramps, and the lag stays below what a hand notices.
constexpr double kLag_s = 0.03;

}  // namespace

MouseDevice::MouseDevice(const Vec3& start_world_m) : position_m_(start_world_m) {
  pointer_.position_world_m = to_array(start_world_m);
  profile_.shows_force_only = true;
  profile_.resolution_m = 0.0;                          // the lag makes positions continuous
  profile_.continuous_force_N = profile_.peak_force_N;  // no motor that could grow hot
}

void MouseDevice::set_pointer(const Vec3& position_world_m, std::uint32_t buttons) noexcept {
  pointers_.publish(Pointer{to_array(position_world_m), buttons});
}

messages::DeviceState MouseDevice::read(std::uint64_t now_ns) noexcept {
  if (pointers_.update()) pointer_ = pointers_.front();
  const double dt_s = started_ && now_ns > last_ns_ ? 1e-9 * static_cast<double>(now_ns - last_ns_) : 0.0;
  started_ = true;
  last_ns_ = now_ns;
  const Vec3 target_m = to_vec3(pointer_.position_world_m);
  position_m_ += (1.0 - std::exp(-dt_s / kLag_s)) * (target_m - position_m_);
  return {to_array(position_m_), to_array((target_m - position_m_) / kLag_s), now_ns, pointer_.buttons};
}

std::array<double, 3> MouseDevice::shown_force_world_N() noexcept {
  forces_.update();
  return forces_.front().force_world_N;
}

}  // namespace myotact::device
