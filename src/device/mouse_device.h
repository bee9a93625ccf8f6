#pragma once

#include "core/vector.h"
#include "device/device.h"
#include "device/simulated_device.h"
#include "realtime/latest_value.h"

namespace myotact::device {

/// The mouse as a stylus: follows a point that the window sets, smoothed; forces are shown, not felt.
class MouseDevice : public Device {
 public:
  explicit MouseDevice(const Vec3& start_world_m) : position_m_(start_world_m), wanted_m_(start_world_m) {}

  realtime::LatestValue<HandTarget>& target() noexcept { return target_; }  // written by the window's thread

  const Profile& profile() const override { return profile_; }
  void open() override {}
  bool ready() const noexcept override { return true; }
  messages::DeviceState read(std::uint64_t now_ns) noexcept override;
  void write(const messages::DeviceCommand&) noexcept override {}

 private:
  Profile profile_{"mouse", 10.0, 0.3};
  realtime::LatestValue<HandTarget> target_;
  Vec3 position_m_;
  Vec3 wanted_m_;
  std::uint64_t last_ns_ = 0;
};

}  // namespace myotact::device
