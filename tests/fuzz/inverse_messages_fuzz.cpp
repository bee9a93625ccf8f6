#include <cmath>

#include "device/drivers/inverse/messages.h"
#include "fuzz/check.h"

/// Texts of the service of an Inverse3: what is taken keeps its limits.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace myotact;
  using namespace myotact::device::inverse;
  const std::string_view text = testing::as_text(data, size);
  read_version(text);
  ServiceMessage message;
  if (!read_message(text, message).empty()) return 0;
  testing::require(message.devices.size() <= kMostDevices);
  for (const DeviceEntry& device : message.devices) {
    testing::require(!device.id.empty() && device.id.size() <= kLongestId);
    for (const auto& axis_m : device.position_service_m) testing::require(std::abs(axis_m.value_or(0.0)) <= 2.0);
    testing::require(device.velocity_service_m_s.allFinite());
    std::string command;
    write_force_command(device.id, {1.0, -2.0, 3.0}, CommandForm::Vector, command);
    ServiceMessage again;
    testing::require(read_message(command, again).empty());  // no id breaks out of its place in the text
  }
  return 0;
}
