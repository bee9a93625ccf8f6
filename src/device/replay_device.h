#pragma once

#include <vector>

#include "device/device.h"

namespace myotact::device {

/// Says again what a device said: one recorded state a tick, the last one for ever.
class ReplayDevice : public Device {
 public:
  explicit ReplayDevice(std::vector<messages::DeviceState> states) : states_(std::move(states)) {}

  const Profile& profile() const override { return profile_; }
  void open() override {}
  bool ready() const noexcept override { return true; }
  messages::DeviceState read(std::uint64_t) noexcept override {
    if (states_.empty()) return {};
    const messages::DeviceState state = states_[next_];
    if (next_ + 1 < states_.size()) ++next_;
    return state;
  }
  void write(const messages::DeviceCommand&) noexcept override {}

 private:
  Profile profile_{"replay", 10.0, 0.3};
  std::vector<messages::DeviceState> states_;
  std::size_t next_ = 0;
};

}  // namespace myotact::device
