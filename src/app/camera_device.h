#pragma once

#include <array>
#include <memory>
#include <string>

#include "device/drivers/device_settings.h"
#include "device/hardware_device.h"

namespace myotact::app {

/// A SpaceMouse that rotates the view instead of moving a tool (--camera).
class CameraDevice {
 public:
  /// Opens it. Throws Error: Usage for an unknown device, Unavailable.
  CameraDevice(const std::string& name, device::DeviceSettings settings);
  ~CameraDevice() { device_->close(); }
  CameraDevice(const CameraDevice&) = delete;
  CameraDevice& operator=(const CameraDevice&) = delete;

  /// How far its cap is pushed now, each -1 .. 1: to the right, up, towards the person. The drawing thread.
  std::array<double, 3> push();
  /// What it wants of the person, once each; empty: nothing new.
  std::string take_hint();

 private:
  std::unique_ptr<device::HardwareDevice> device_;
  std::string told_;
};

}  // namespace myotact::app
