#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "device/device.h"

namespace myotact::device {

/// Plays recorded states, one a read, whatever the clock says; afterwards the last one stays. Forces go nowhere.
/// The first read after open() only shows the first state: it is the loop's look at the device before its first tick.
class ReplayDevice : public Device {
 public:
  ReplayDevice(std::vector<messages::DeviceState> states, const DeviceProfile& profile);

  const std::string& name() const override { return name_; }
  const DeviceProfile& profile() const override { return profile_; }
  void open() override {
    next_ = 0;
    previews_ = !states_.empty();
  }
  void close() noexcept override {}
  bool connected() const noexcept override { return true; }
  messages::DeviceState read(std::uint64_t now_ns) noexcept override;
  void write(const messages::DeviceCommand&) noexcept override {}

  bool finished() const noexcept { return next_ >= states_.size(); }

 private:
  std::string name_ = "replay";
  DeviceProfile profile_;
  std::vector<messages::DeviceState> states_;
  std::size_t next_ = 0;
  bool previews_ = false;
};

}  // namespace myotact::device
