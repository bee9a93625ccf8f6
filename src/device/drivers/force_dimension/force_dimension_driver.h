#pragma once

#include <memory>
#include <string>
#include <vector>

#include "device/drivers/force_dimension/force_dimension_device.h"

namespace myotact::device::force_dimension {

/// Force Dimension devices: "force_dimension", "force_dimension:2" in the library's order. All drivers of a process
/// share the library.
class ForceDimensionDriver : public Driver {
 public:
  explicit ForceDimensionDriver(const ForceDimensionSettings& settings = {}) : settings_(settings) {}

  const std::string& name() const override { return name_; }
  /// Opens each device for a moment, but for those that this program has open.
  std::vector<DeviceFinding> find() override;
  std::unique_ptr<HardwareDevice> make(const std::string& name) override;

 private:
  const std::string name_ = "force_dimension";
  ForceDimensionSettings settings_;
};

}  // namespace myotact::device::force_dimension
