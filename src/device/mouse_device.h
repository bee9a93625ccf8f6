#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "core/vector.h"
#include "device/device.h"
#include "realtime/latest_value.h"

namespace myotact::device {

/// The pointer of the window as a stylus. The force cannot be felt; it is kept for the window to draw.
class MouseDevice : public Device {
 public:
  explicit MouseDevice(const Vec3& start_world_m);

  /// Window's thread: where the pointer is in the world, and the buttons as in DeviceState.
  void set_pointer(const Vec3& position_world_m, std::uint32_t buttons) noexcept;

  const std::string& name() const override { return name_; }
  const DeviceProfile& profile() const override { return profile_; }
  void open() override {}
  void close() noexcept override {}
  bool connected() const noexcept override { return true; }
  /// The stylus follows the pointer with a lag of first order: a window moves its pointer in jumps at 60 Hz.
  messages::DeviceState read(std::uint64_t now_ns) noexcept override;
  void write(const messages::DeviceCommand& command) noexcept override { forces_.publish(command); }

  /// Window's thread: the newest force written [N].
  std::array<double, 3> shown_force_world_N() noexcept;

 private:
  struct Pointer {
    std::array<double, 3> position_world_m{};
    std::uint32_t buttons = 0;
  };

  std::string name_ = "mouse";
  DeviceProfile profile_;
  realtime::LatestValue<Pointer> pointers_;
  realtime::LatestValue<messages::DeviceCommand> forces_;
  Vec3 position_m_;
  Pointer pointer_;
  std::uint64_t last_ns_ = 0;
  bool started_ = false;
};

}  // namespace myotact::device
