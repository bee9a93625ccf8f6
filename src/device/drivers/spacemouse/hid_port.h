#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace myotact::device::spacemouse {

/// An open HID device. One thread.
class HidPort {
 public:
  virtual ~HidPort() = default;
  /// One input report, never waits: its length, 0 when there is none, below 0 when the device is gone.
  virtual int read(std::span<std::uint8_t> report) noexcept = 0;
  /// One output report. False: the device did not take it.
  virtual bool write(std::span<const std::uint8_t> report) noexcept = 0;
};

/// One interface of a device that is plugged in.
struct HidEntry {
  std::string path;  // "/dev/hidraw0"
  std::uint16_t vendor = 0, product = 0;
  std::uint16_t usage_page = 0, usage = 0;
  std::string maker, model, serial;  // as the device says, any may be empty
  bool may_open = true;              // this user may read and write it
};

/// What is plugged in. Any thread, one at a time.
class HidBus {
 public:
  virtual ~HidBus() = default;
  virtual std::vector<HidEntry> list() = 0;
  /// Throws Error Unavailable.
  virtual std::unique_ptr<HidPort> open(const std::string& path) = 0;
};

/// The kernel's HID devices by hidapi (hidraw: other programs that read the same device still do).
std::unique_ptr<HidBus> make_hidraw_bus();

}  // namespace myotact::device::spacemouse
