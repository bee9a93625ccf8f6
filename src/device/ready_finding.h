#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "device/hardware_device.h"

namespace myotact::device {

/// The place in `findings` (one at least) of the device of this name, which can be opened. Throws Error Unavailable
/// with cause and remedy where there is none, or it cannot; where nothing at all is ready, with the cause of the first.
std::size_t ready_finding(const std::vector<DeviceFinding>& findings, const std::string& name);

}  // namespace myotact::device
