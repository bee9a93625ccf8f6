#pragma once

#include <memory>
#include <string>
#include <vector>

#include "device/drivers/falcon/transport.h"

namespace myotact::device::falcon {

/// Why something on USB cannot be used, and what to do about it: one sentence each. Empty: it can.
struct UsbTrouble {
  std::string cause, remedy;
};

/// A Falcon that is plugged in.
struct FalconOnUsb {
  std::string place;   // bus and ports, "1-2.3": the same after it was unplugged and plugged into the same socket
  UsbTrouble trouble;  // why it cannot be opened now
};

struct UsbListing {
  std::vector<FalconOnUsb> falcons;  // by place
  UsbTrouble trouble;                // why USB itself cannot be looked at
};

/// What is plugged in. Any thread, one at a time.
class UsbBus {
 public:
  virtual ~UsbBus() = default;
  virtual UsbListing list() = 0;
  /// Throws Error Unavailable: cause and remedy.
  virtual std::unique_ptr<Transport> open(const std::string& place) = 0;
};

/// The kernel's USB devices by libusb. Each call looks anew.
std::shared_ptr<UsbBus> make_libusb_bus();

}  // namespace myotact::device::falcon
