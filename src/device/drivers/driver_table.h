#pragma once

#include <memory>
#include <string>
#include <vector>

#include "device/drivers/device_settings.h"
#include "device/hardware_device.h"

namespace myotact::device {

/// Every family of devices on the table, in the order of "myotact devices".
std::vector<std::unique_ptr<Driver>> make_drivers(const DeviceSettings& settings);

/// Names of the families: "falcon", "touch"; a device is named by its family, the second one "falcon:2".
const std::vector<std::string>& driver_names();

/// Exchanges a second with a device of that family, as its maker or its bus has them: what is reached is measured by
/// "myotact devices --test". (Source: makers' figures; HDAPI's default; the bus's 8 ms of a SpaceMouse)
double nominal_rate_Hz(const std::string& family);

/// Whether this names a device on the table, plugged in or not.
bool is_on_the_table(const std::string& device);

}  // namespace myotact::device
