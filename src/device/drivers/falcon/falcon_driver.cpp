#include "device/drivers/falcon/falcon_driver.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"

namespace myotact::device::falcon {

namespace {

constexpr const char* kTitle = "Novint Falcon";

/// The device at a place in the list. As many must be there as when it was made: of two, the one that is left is not
/// taken for the one that was unplugged. It may come back in another socket.
std::unique_ptr<Transport> open_at(UsbBus& bus, std::size_t index, std::size_t count) {
  const UsbListing listing = bus.list();
  if (listing.falcons.size() < count) {
    const std::string why = listing.trouble.cause.empty() ? "" : "; " + listing.trouble.cause;
    throw Error(ExitStatus::Unavailable, fmt::format("{} of {} Falcons are plugged in{}; plug in what is missing",
                                                     listing.falcons.size(), count, why));
  }
  return bus.open(listing.falcons[index].place);
}

}  // namespace

FalconDriver::FalconDriver(const FalconSettings& settings, std::shared_ptr<UsbBus> bus)
    : settings_(settings), bus_(std::move(bus)) {}

std::vector<DeviceFinding> FalconDriver::find() {
  std::vector<DeviceFinding> findings;
  const UsbListing listing = bus_->list();
  for (const auto& [place, trouble] : listing.falcons) {
    const std::size_t number = findings.size() + 1;
    findings.push_back({number == 1 ? name_ : fmt::format("{}:{}", name_, number),
                        fmt::format("{} at USB {}", kTitle, place), trouble.cause.empty(), trouble.cause,
                        trouble.remedy});
  }
  if (!findings.empty()) return findings;
  if (!listing.trouble.cause.empty()) return {{name_, kTitle, false, listing.trouble.cause, listing.trouble.remedy}};
  return {{name_, kTitle, false, "no Falcon is plugged in", "plug in its power, then its USB cable"}};
}

std::unique_ptr<HardwareDevice> FalconDriver::make(const std::string& name) {
  const std::vector<DeviceFinding> findings = find();
  const auto found = std::find_if(findings.begin(), findings.end(), [&](const auto& row) { return row.name == name; });
  if (found == findings.end()) {
    throw Error(ExitStatus::Unavailable,
                fmt::format("there is no device \"{}\"; the last one found is \"{}\"", name, findings.back().name));
  }
  if (!found->ready) throw Error(ExitStatus::Unavailable, fmt::format("{}: {}; {}", name, found->cause, found->remedy));
  const auto index = static_cast<std::size_t>(found - findings.begin());
  return std::make_unique<FalconDevice>(
      name, settings_, [bus = bus_, index, count = findings.size()] { return open_at(*bus, index, count); });
}

}  // namespace myotact::device::falcon
