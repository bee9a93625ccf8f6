#include "device/drivers/spacemouse/spacemouse_driver.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "device/drivers/spacemouse/models.h"
#include "device/drivers/spacemouse/spacemouse_device.h"
#include "device/own_place.h"
#include "device/ready_finding.h"

namespace myotact::device::spacemouse {

namespace {

std::vector<HidEntry> caps_on(HidBus& bus) {
  std::vector<HidEntry> caps = bus.list();
  std::erase_if(caps, [](const HidEntry& entry) { return !is_cap(entry); });
  const auto in_order = [](const HidEntry& cap) { return std::pair(cap.path.size(), cap.path); };  // hidraw2, hidraw10
  std::ranges::sort(caps, {}, in_order);
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

/// What distinguishes a device from the others as long as it is plugged in, and where it has a serial number also
/// afterwards.
std::vector<std::string> identities_of(const std::vector<HidEntry>& caps) {
  std::vector<std::string> identities;
  for (const HidEntry& cap : caps) {
    identities.push_back(
        fmt::format("{:04x}:{:04x} {}", cap.vendor, cap.product, cap.serial.empty() ? cap.path : cap.serial));
  }
  return identities;
}

/// The device that was `own` when there were those of `then`.
std::unique_ptr<HidPort> open_own(HidBus& bus, const std::string& own, const std::vector<std::string>& then) {
  const std::vector<HidEntry> caps = caps_on(bus);
  const auto index = own_place(identities_of(caps), own, then);
  if (!index) {
    throw Error(ExitStatus::Unavailable,
                fmt::format("{} of {} SpaceMouse devices is plugged in; plug in the others", caps.size(), then.size()));
  }
  return bus.open(caps[*index].path);
}

}  // namespace

SpaceMouseDriver::SpaceMouseDriver(const MotionSettings& settings, std::shared_ptr<HidBus> bus)
    : settings_(settings), bus_(std::move(bus)) {}

std::vector<DeviceFinding> SpaceMouseDriver::find() {
  return findings_of(caps_on(*bus_));
}

std::vector<DeviceFinding> SpaceMouseDriver::findings_of(const std::vector<HidEntry>& caps) const {
  std::vector<DeviceFinding> findings;
  for (const HidEntry& cap : caps) {
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
  const std::vector<HidEntry> caps = caps_on(*bus_);
  const std::size_t place = ready_finding(findings_of(caps), name);
  const std::vector<std::string> identities = identities_of(caps);
  const std::string& own = identities[place];
  return std::make_unique<SpaceMouseDevice>(
      name, [bus = bus_, own, identities] { return open_own(*bus, own, identities); }, settings_);
}

}  // namespace myotact::device::spacemouse
