#pragma once

#include <memory>
#include <string>
#include <vector>

#include "device/drivers/spacemouse/hid_port.h"
#include "device/drivers/spacemouse/motion.h"
#include "device/hardware_device.h"

namespace myotact::device::spacemouse {

/// 3Dconnexion SpaceMouse devices: "spacemouse", "spacemouse:2" in the order of their paths.
class SpaceMouseDriver : public Driver {
 public:
  explicit SpaceMouseDriver(const MotionSettings& settings = {}, std::shared_ptr<HidBus> bus = make_hidraw_bus());

  const std::string& name() const override { return name_; }
  std::vector<DeviceFinding> find() override;
  std::unique_ptr<HardwareDevice> make(const std::string& name) override;

 private:
  std::vector<DeviceFinding> findings_of(const std::vector<HidEntry>& caps) const;

  const std::string name_ = "spacemouse";
  MotionSettings settings_;
  std::shared_ptr<HidBus> bus_;  // the devices made use it, too
};

}  // namespace myotact::device::spacemouse
