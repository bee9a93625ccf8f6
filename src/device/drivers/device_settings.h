#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "core/overrides.h"
#include "core/vector.h"
#include "device/drivers/falcon/falcon_device.h"
#include "device/drivers/force_dimension/settings.h"
#include "device/drivers/inverse/settings.h"
#include "device/drivers/spacemouse/motion.h"
#include "device/drivers/touch/settings.h"

namespace myotact::device {

/// Range of falcon.counts_per_Nm: the maker's peak force would need 18 000 (exchange.h).
inline constexpr double kLowestFalconScale = 100.0, kHighestFalconScale = 20'000.0;

/// How a device lies on the table and what its motion is in the world.
struct TablePlacement {
  Vec3 turn_deg = Vec3::Zero();  // about its right, up and towards axes in this order: a device that stands turned
  double scale = 1.0;            // metres in the world for a metre on the table
  double bubble_radius_m = 0.0;  // placed_device.h; 0: none
};

/// What a lab knows of its devices and the program cannot: files, calibrations, placement.
struct DeviceSettings {
  falcon::FalconSettings falcon;
  force_dimension::ForceDimensionSettings force_dimension;
  inverse::InverseSettings inverse;
  spacemouse::MotionSettings spacemouse;
  touch::TouchSettings touch;
  std::map<std::string, TablePlacement> placements;  // by the name of --device, "touch" or "touch:2"
};

/// $XDG_CONFIG_HOME/myotact/devices.json, or ~/.config/... in its place; empty without a home.
std::filesystem::path device_settings_file();

/// The file's settings (assets/devices/README.md), defaults where it is missing or a key of it; `overrides` are put
/// over it, "falcon.firmware=FILE". Throws Error BadData: file, place, value, range.
DeviceSettings read_device_settings(const std::filesystem::path& file, const Overrides& overrides);

/// Whether a key of --set is about a device: "falcon.firmware".
bool is_device_setting(const std::string& key);

/// Puts values over those in the file, which is made where it is missing; what else is in it stays, but for comments.
/// Throws Error: not readable, no settings with these values, or not writable.
void keep_device_settings(const std::filesystem::path& file, const Overrides& values);

}  // namespace myotact::device
