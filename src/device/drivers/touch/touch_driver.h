#pragma once

#include <memory>
#include <string>
#include <vector>

#include "device/drivers/touch/settings.h"
#include "device/drivers/touch/touch_device.h"

namespace myotact::device::touch {

/// 3D Systems Touch, Touch X and Phantom Omni: "touch", "touch:2" in the order of the settings' configurations. All
/// drivers of a process share the maker's library and its servo loop.
class TouchDriver : public Driver {
 public:
  explicit TouchDriver(const TouchSettings& settings = {}) : settings_(settings) {}

  const std::string& name() const override { return name_; }
  /// Opens each device for a moment, unless one is being felt.
  std::vector<DeviceFinding> find() override;
  std::unique_ptr<HardwareDevice> make(const std::string& name) override;

 private:
  const std::string name_ = "touch";
  TouchSettings settings_;
};

}  // namespace myotact::device::touch
