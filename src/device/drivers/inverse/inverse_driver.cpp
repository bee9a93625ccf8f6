#include "device/drivers/inverse/inverse_driver.h"

#include <algorithm>

#include <fmt/format.h>

#include "device/drivers/inverse/greeting.h"
#include "device/drivers/inverse/inverse_device.h"
#include "device/drivers/inverse/service_link.h"

namespace myotact::device::inverse {

namespace {

std::string name_at(const std::string& family, std::size_t place) {
  return place == 0 ? family : fmt::format("{}:{}", family, place + 1);
}

}  // namespace

/// Of the devices, in the service's order. Throws Error.
std::vector<std::string> InverseDriver::ids() {
  const auto link = make_websocket_link(settings_);
  const Greeting greeting = greet(*link, settings_);
  link->close();
  if (greeting.inventory.devices.empty()) {
    throw ServiceError("the Inverse Service knows no Inverse3",
                       "switch one on and plug in its USB cable; the service writes what it finds to "
                       "/var/log/haply-inverse-service");
  }
  std::vector<std::string> ids;
  for (const DeviceEntry& device : greeting.inventory.devices) ids.push_back(device.id);
  return ids;
}

std::vector<DeviceFinding> InverseDriver::find() {
  std::vector<DeviceFinding> findings;
  try {
    for (const std::string& id : ids()) {
      findings.push_back({name_at(name_, findings.size()), "Haply Inverse3 " + id, true, "", ""});
    }
  } catch (const ServiceError& error) {
    findings.push_back({name_, "Haply Inverse3", false, error.cause, error.remedy});
  } catch (const Error& error) {
    findings.push_back({name_, "Haply Inverse3", false, error.what(), "give an address like 127.0.0.1"});
  }
  return findings;
}

std::unique_ptr<HardwareDevice> InverseDriver::make(const std::string& name) {
  const std::vector<std::string> found = ids();
  for (std::size_t place = 0; place < found.size(); ++place) {
    if (name_at(name_, place) != name) continue;
    return std::make_unique<InverseDevice>(name, found[place], place, settings_, make_websocket_link(settings_));
  }
  throw ServiceError(
      fmt::format("there is no device \"{}\"", name),
      fmt::format("the last one that the Inverse Service knows is \"{}\"", name_at(name_, found.size() - 1)));
}

}  // namespace myotact::device::inverse
