#include "device/drivers/spacemouse/spacemouse_driver.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "device/drivers/spacemouse/models.h"
#include "device/drivers/spacemouse/spacemouse_device.h"

namespace myotact::device::spacemouse {

namespace {

std::vector<HidEntry> caps_on(HidBus& bus) {
  std::vector<HidEntry> caps = bus.list();
  std::erase_if(caps, [](const HidEntry& entry) { return !is_cap(entry); });
  std::sort(caps.begin(), caps.end(), [](const HidEntry& a, const HidEntry& b) { return a.path < b.path; });
  return caps;
}

DeviceFinding finding_of(const HidEntry& cap, const std::string& name) {
  DeviceFinding finding{name, fmt::format("3Dconnexion {}", model_of(cap.vendor, cap.product)), cap.may_open, "", ""};
  if (!cap.serial.empty()) finding.title += " " + cap.serial;
  if (!cap.may_open) {
    finding.cause = fmt::format("{}: this user may not read and write it", cap.path);
    finding.remedy =
        "copy assets/devices/udev/70-myotact.rules to /etc/udev/rules.d, run \"sudo udevadm control --reload\" and "
        "plug "
        "the SpaceMouse in again";
  }
  return finding;
}

/// The device at a place in the list. As many must be there as when it was made: of two, the one that is left is not
/// taken for the one that was unplugged.
std::unique_ptr<HidPort> open_at(HidBus& bus, std::size_t place, std::size_t count) {
  const std::vector<HidEntry> caps = caps_on(bus);
  if (caps.size() < count) {
    throw Error(ExitStatus::Unavailable,
                fmt::format("{} of {} SpaceMouse devices is plugged in; plug in the others", caps.size(), count));
  }
  return bus.open(caps[place].path);
}

}  // namespace

SpaceMouseDriver::SpaceMouseDriver(const MotionSettings& settings, std::shared_ptr<HidBus> bus)
    : settings_(settings), bus_(std::move(bus)) {}

std::vector<DeviceFinding> SpaceMouseDriver::find() {
  std::vector<DeviceFinding> findings;
  for (const HidEntry& cap : caps_on(*bus_)) {
    const std::size_t number = findings.size() + 1;
    findings.push_back(finding_of(cap, number == 1 ? name_ : fmt::format("{}:{}", name_, number)));
  }
  if (findings.empty()) {
    findings.push_back({name_, "3Dconnexion SpaceMouse", false, "no SpaceMouse is plugged in",
                        "plug one in, by its cable or its receiver"});
  }
  return findings;
}

std::unique_ptr<HardwareDevice> SpaceMouseDriver::make(const std::string& name) {
  const std::vector<DeviceFinding> findings = find();
  const auto found = std::find_if(findings.begin(), findings.end(), [&](const auto& row) { return row.name == name; });
  if (found == findings.end()) {
    throw Error(ExitStatus::Unavailable,
                fmt::format("there is no device \"{}\"; the last one found is \"{}\"", name, findings.back().name));
  }
  if (!found->ready) {
    throw Error(ExitStatus::Unavailable, fmt::format("{}: {}; {}", name, found->cause, found->remedy));
  }
  const auto place = static_cast<std::size_t>(found - findings.begin());
  return std::make_unique<SpaceMouseDevice>(
      name, [bus = bus_, place, count = findings.size()] { return open_at(*bus, place, count); }, settings_);
}

}  // namespace myotact::device::spacemouse
