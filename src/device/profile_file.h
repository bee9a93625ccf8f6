#pragma once

#include <string>
#include <vector>

#include "device/device.h"

namespace myotact::device {

/// A device profile of a file (assets/devices/README.md).
struct NamedProfile {
  std::string name, title;
  DeviceProfile profile;
};

/// Reads one of assets/devices by name, or a file by path. Throws Error NoInput (names the known ones) or BadData
/// (file, place, value, range).
NamedProfile load_profile(const std::string& name_or_path);

/// Of the device that a scene names: "simulated" has the default, "simulated:touch" the profile "touch". Throws as
/// load_profile.
DeviceProfile simulated_profile(const std::string& device);

/// Names of those in assets/devices, sorted.
std::vector<std::string> built_in_profiles();

}  // namespace myotact::device
