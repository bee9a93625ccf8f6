#pragma once

#include <cstdint>
#include <string>

#include "messages/device.h"

namespace myotact::device {

/// What a device can do; the force gate keeps to it.
struct Profile {
  std::string name;
  double peak_force_N = 3.3;
  double workspace_m = 0.16;  // smallest extent, for the view
};

/// A force-feedback device of three axes. read() and write() belong to the haptic thread and are real-time safe.
class Device {
 public:
  virtual ~Device() = default;

  virtual const Profile& profile() const = 0;
  /// May wait and allocate. Throws Error Unavailable saying why it does not open and what to do.
  virtual void open() = 0;
  /// False once the device is lost: its force is zero then.
  virtual bool ready() const noexcept = 0;
  virtual messages::DeviceState read(std::uint64_t now_ns) noexcept = 0;
  virtual void write(const messages::DeviceCommand& command) noexcept = 0;
};

}  // namespace myotact::device
