#include "device/drivers/driver_table.h"

#include <algorithm>

#include "device/drivers/falcon/falcon_driver.h"
#include "device/drivers/force_dimension/force_dimension_driver.h"
#include "device/drivers/inverse/inverse_driver.h"
#include "device/drivers/spacemouse/spacemouse_driver.h"
#include "device/drivers/touch/touch_driver.h"

namespace myotact::device {

std::vector<std::unique_ptr<Driver>> make_drivers(const DeviceSettings& settings) {
  std::vector<std::unique_ptr<Driver>> drivers;
  drivers.push_back(std::make_unique<touch::TouchDriver>(settings.touch));
  drivers.push_back(std::make_unique<falcon::FalconDriver>(settings.falcon));
  drivers.push_back(std::make_unique<force_dimension::ForceDimensionDriver>(settings.force_dimension));
  drivers.push_back(std::make_unique<inverse::InverseDriver>(settings.inverse));
  drivers.push_back(std::make_unique<spacemouse::SpaceMouseDriver>(settings.spacemouse));
  return drivers;
}

const std::vector<std::string>& driver_names() {
  static const std::vector<std::string> kNames = {"touch", "falcon", "force_dimension", "inverse3", "spacemouse"};
  return kNames;
}

double nominal_rate_Hz(const std::string& family) {
  if (family == "force_dimension") return 2000.0;
  if (family == "inverse3") return 4000.0;
  if (family == "spacemouse") return 125.0;
  return 1000.0;
}

bool is_on_the_table(const std::string& device) {
  const std::string family = device.substr(0, device.find(':'));
  return std::find(driver_names().begin(), driver_names().end(), family) != driver_names().end();
}

}  // namespace myotact::device
