#pragma once

#include <memory>
#include <string>
#include <vector>

#include "device/drivers/inverse/settings.h"
#include "device/hardware_device.h"

namespace myotact::device::inverse {

/// Haply Inverse3 devices that the Inverse Service of this machine knows: "inverse3", "inverse3:2" in its order.
class InverseDriver : public Driver {
 public:
  explicit InverseDriver(const InverseSettings& settings = {}) : settings_(settings) {}

  const std::string& name() const override { return name_; }
  /// Asks the service: up to about two seconds when something else listens in its place.
  std::vector<DeviceFinding> find() override;
  std::unique_ptr<HardwareDevice> make(const std::string& name) override;

 private:
  std::vector<std::string> ids();

  const std::string name_ = "inverse3";
  InverseSettings settings_;
};

}  // namespace myotact::device::inverse
