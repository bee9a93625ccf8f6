#include "app/camera_device.h"

#include <utility>

#include "app/equipment.h"
#include "core/error.h"
#include "realtime/periodic_loop.h"

namespace myotact::app {

CameraDevice::CameraDevice(const std::string& name, device::DeviceSettings settings) {
  if (!name.starts_with("spacemouse")) {
    throw Error(ExitStatus::Usage,
                "--camera " + name + ": only a spacemouse rotates the view; --device gives it a tool");
  }
  settings.spacemouse.mode = device::spacemouse::MotionMode::Position;
  settings.spacemouse.full_offset_m = 1.0;  // the position is the push
  device_ = make_device(settings, name);
  device_->open();
}

std::array<double, 3> CameraDevice::push() {
  const messages::DeviceState state = device_->read(realtime::steady_now_ns());
  return device_->connected() ? state.stylus_position_world_m : std::array<double, 3>{};
}

std::string CameraDevice::take_hint() {
  const std::string hint = device_->report().hint;
  return std::exchange(told_, hint) == hint ? std::string() : hint;
}

}  // namespace myotact::app
