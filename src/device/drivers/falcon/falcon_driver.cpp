#include "device/drivers/falcon/falcon_driver.h"

#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "device/own_place.h"
#include "device/ready_finding.h"

namespace myotact::device::falcon {

namespace {

constexpr const char* kTitle = "Novint Falcon";

std::vector<std::string> places_of(const UsbListing& listing) {
  std::vector<std::string> places;
  for (const FalconOnUsb& falcon : listing.falcons) places.push_back(falcon.place);
  return places;
}

/// The device that was at `own` when there were those of `then`.
std::unique_ptr<Transport> open_own(UsbBus& bus, const std::string& own, const std::vector<std::string>& then) {
  const UsbListing listing = bus.list();
  const std::vector<std::string> places = places_of(listing);
  const auto index = own_place(places, own, then);
  if (!index) {
    const std::string why = listing.trouble.cause.empty() ? "" : "; " + listing.trouble.cause;
    throw Error(ExitStatus::Unavailable, fmt::format("{} of {} Falcons are plugged in, and none at USB {}{}; plug in "
                                                     "what is missing",
                                                     places.size(), then.size(), own, why));
  }
  return bus.open(places[*index]);
}

}  // namespace

FalconDriver::FalconDriver(const FalconSettings& settings, std::shared_ptr<UsbBus> bus)
    : settings_(settings), bus_(std::move(bus)) {}

std::vector<DeviceFinding> FalconDriver::find() {
  return findings_of(bus_->list());
}

std::vector<DeviceFinding> FalconDriver::findings_of(const UsbListing& listing) const {
  std::vector<DeviceFinding> findings;
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
  const UsbListing listing = bus_->list();
  const std::size_t place = ready_finding(findings_of(listing), name);
  const std::vector<std::string> places = places_of(listing);
  const std::string& own = places[place];
  return std::make_unique<FalconDevice>(name, settings_,
                                        [bus = bus_, own, places] { return open_own(*bus, own, places); });
}

}  // namespace myotact::device::falcon
