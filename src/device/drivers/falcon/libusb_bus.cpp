#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "device/drivers/falcon/libusb_transport.h"
#include "device/drivers/falcon/usb_bus.h"

namespace myotact::device::falcon {

namespace {

constexpr std::uint16_t kVendor = 0x0403, kProduct = 0xcb48;  // FTDI's number, which the maker used; libnifalcon
constexpr const char* kUsbFolder = "/dev/bus/usb";
constexpr int kMostPorts = 7;  // deeper than USB allows hubs

struct ListEnd {
  void operator()(libusb_device** list) const noexcept { libusb_free_device_list(list, 1); }
};

/// All devices of the system, as libusb finds them now.
struct Devices {
  UsbContext context;  // outlives the list
  std::unique_ptr<libusb_device*, ListEnd> list;
  std::vector<std::pair<std::string, libusb_device*>> falcons;  // by place
  int code = LIBUSB_SUCCESS;
};

std::string place_of(libusb_device* device) {
  std::array<std::uint8_t, kMostPorts> ports{};
  const int count = libusb_get_port_numbers(device, ports.data(), kMostPorts);
  std::string place = std::to_string(libusb_get_bus_number(device));
  for (int i = 0; i < count; ++i) place += fmt::format("{}{}", i == 0 ? '-' : '.', ports[static_cast<std::size_t>(i)]);
  return place;
}

Devices look() {
  Devices devices;
  libusb_context* context = nullptr;
  devices.code = libusb_init(&context);
  if (devices.code != LIBUSB_SUCCESS) return devices;
  devices.context.reset(context);
  libusb_device** list = nullptr;
  const auto count = libusb_get_device_list(context, &list);
  if (count < 0) {
    devices.code = static_cast<int>(count);
    return devices;
  }
  devices.list.reset(list);
  for (libusb_device* device : std::span(list, static_cast<std::size_t>(count))) {
    libusb_device_descriptor about{};
    if (libusb_get_device_descriptor(device, &about) != LIBUSB_SUCCESS) continue;
    if (about.idVendor == kVendor && about.idProduct == kProduct)
      devices.falcons.emplace_back(place_of(device), device);
  }
  std::sort(devices.falcons.begin(), devices.falcons.end());
  return devices;
}

UsbTrouble trouble_of(int code, libusb_device* device) {
  const std::string node =
      fmt::format("{}/{:03}/{:03}", kUsbFolder, libusb_get_bus_number(device), libusb_get_device_address(device));
  switch (code) {
    case LIBUSB_SUCCESS:
      return {};
    case LIBUSB_ERROR_ACCESS:
      return {node + ": this user may not read and write it",
              "copy assets/devices/udev/70-myotact.rules to /etc/udev/rules.d, run \"sudo udevadm control --reload\" "
              "and plug the Falcon in again"};
    case LIBUSB_ERROR_BUSY:
      return {node + ": another program uses it", "end that program, or the other device of this one that holds it"};
    case LIBUSB_ERROR_NO_DEVICE:
      return {node + ": it was unplugged just now", "plug the Falcon in again"};
    default:
      return {fmt::format("{}: {}", node, libusb_strerror(code)), "unplug the Falcon and plug it in again"};
  }
}

UsbTrouble trouble_of_usb(int code) {
  if (!std::filesystem::is_directory(kUsbFolder)) {
    return {fmt::format("there is no {}: this system shows no USB devices to programs", kUsbFolder),
            "in a container or a virtual machine, hand the Falcon's USB on to it"};
  }
  if (code == LIBUSB_SUCCESS) return {};
  return {fmt::format("USB cannot be listed: {}", libusb_strerror(code)), "look into the system's log for USB"};
}

/// The handle with its interface claimed, or libusb's code.
std::pair<UsbHandle, int> claim(libusb_device* device) {
  libusb_device_handle* opened = nullptr;
  int code = libusb_open(device, &opened);
  if (code != LIBUSB_SUCCESS) return {nullptr, code};
  UsbHandle handle(opened);
  code = libusb_claim_interface(opened, kUsbInterface);
  if (code != LIBUSB_SUCCESS) handle.reset();
  return {std::move(handle), code};
}

class LibusbBus : public UsbBus {
 public:
  UsbListing list() override {
    const Devices devices = look();
    UsbListing listing;
    for (const auto& [place, device] : devices.falcons) {
      const auto [handle, code] = claim(device);
      listing.falcons.push_back({place, trouble_of(code, device)});
      if (handle) libusb_release_interface(handle.get(), kUsbInterface);
    }
    if (listing.falcons.empty()) listing.trouble = trouble_of_usb(devices.code);
    return listing;
  }

  std::unique_ptr<Transport> open(const std::string& place) override {
    Devices devices = look();
    const auto found = std::find_if(devices.falcons.begin(), devices.falcons.end(),
                                    [&](const auto& falcon) { return falcon.first == place; });
    if (found == devices.falcons.end()) {
      const UsbTrouble trouble = trouble_of_usb(devices.code);
      const std::string why = trouble.cause.empty() ? "plug it in" : trouble.cause + "; " + trouble.remedy;
      throw Error(ExitStatus::Unavailable, fmt::format("USB {}: there is no Falcon; {}", place, why));
    }
    auto [handle, code] = claim(found->second);
    if (!handle) {
      const UsbTrouble trouble = trouble_of(code, found->second);
      throw Error(ExitStatus::Unavailable, trouble.cause + "; " + trouble.remedy);
    }
    devices.list.reset();
    return std::make_unique<LibusbTransport>(std::move(devices.context), std::move(handle));
  }
};

}  // namespace

std::shared_ptr<UsbBus> make_libusb_bus() {
  return std::make_shared<LibusbBus>();
}

}  // namespace myotact::device::falcon
