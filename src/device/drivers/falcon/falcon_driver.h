#pragma once

#include <memory>
#include <string>
#include <vector>

#include "device/drivers/falcon/falcon_device.h"
#include "device/drivers/falcon/usb_bus.h"

namespace myotact::device::falcon {

/// Novint Falcons: "falcon", "falcon:2" in the order of their places on USB.
class FalconDriver : public Driver {
 public:
  explicit FalconDriver(const FalconSettings& settings = {}, std::shared_ptr<UsbBus> bus = make_libusb_bus());

  const std::string& name() const override { return name_; }
  std::vector<DeviceFinding> find() override;
  std::unique_ptr<HardwareDevice> make(const std::string& name) override;

 private:
  std::vector<DeviceFinding> findings_of(const UsbListing& listing) const;

  const std::string name_ = "falcon";
  FalconSettings settings_;
  std::shared_ptr<UsbBus> bus_;  // the devices made use it, too
};

}  // namespace myotact::device::falcon
