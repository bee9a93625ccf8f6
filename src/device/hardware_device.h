#pragma once

#include <memory>
#include <string>
#include <vector>

#include "device/device.h"
#include "messages/device_report.h"

namespace myotact::device {

using messages::DevicePhase;
using messages::DeviceReport;

/// A device on the table. What it reports and is sent is in its own frame: x to the right of the person who sits before
/// it, y up, z towards that person, metres from the middle of its workspace. In phases other than Ready it takes no
/// force, whatever is written, and connected() is false.
class HardwareDevice : public Device {
 public:
  /// Any thread; never waits.
  virtual DeviceReport report() const noexcept = 0;
  /// Where the maker's library makes the ticks; null: whoever reads and writes does.
  virtual ServoClock* servo_clock() noexcept { return nullptr; }
};

/// One row of "myotact devices".
struct DeviceFinding {
  std::string name;    // what --device takes: "falcon", the second one "falcon:2"
  std::string title;   // maker, model, serial number where it is known
  bool ready = false;  // it can be opened now
  std::string cause;   // why not: one sentence that names the file, the library or the device; empty when ready
  std::string remedy;  // what to do about it: one sentence; empty when ready
};

/// A family of devices.
class Driver {
 public:
  virtual ~Driver() = default;
  virtual const std::string& name() const = 0;  // "falcon"
  /// What is plugged in. One row that is not ready when nothing is, or nothing can be: it states why. Never throws for
  /// what it meets.
  virtual std::vector<DeviceFinding> find() = 0;
  /// One of those found, closed. Throws Error Unavailable (cause and remedy).
  virtual std::unique_ptr<HardwareDevice> make(const std::string& name) = 0;
};

}  // namespace myotact::device
