#include "uhid_spacemouse.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>

#include <fcntl.h>
#include <linux/uhid.h>
#include <unistd.h>

namespace myotact::device::spacemouse {

namespace {

/// A multi-axis controller: reports 1 and 2 are translation and rotation, 3 has two buttons, 4 is the lamp.
constexpr std::array<std::uint8_t, 95> kDescriptor = {
    0x05, 0x01, 0x09, 0x08, 0xA1, 0x01,                                                  // generic desktop, multi-axis
    0xA1, 0x00, 0x85, 0x01, 0x16, 0xA2, 0xFE, 0x26, 0x5E, 0x01,                          // report 1, -350 .. 350
    0x09, 0x30, 0x09, 0x31, 0x09, 0x32, 0x75, 0x10, 0x95, 0x03, 0x81, 0x06, 0xC0,        // X Y Z, 16 bit
    0xA1, 0x00, 0x85, 0x02, 0x09, 0x33, 0x09, 0x34, 0x09, 0x35, 0x75, 0x10, 0x95, 0x03,  // report 2: RX RY RZ
    0x81, 0x06, 0xC0,                                                                    //
    0xA1, 0x02, 0x85, 0x03, 0x05, 0x09, 0x19, 0x01, 0x29, 0x02, 0x15, 0x00, 0x25, 0x01,  // report 3: two buttons
    0x75, 0x01, 0x95, 0x02, 0x81, 0x02, 0x95, 0x0E, 0x81, 0x03, 0xC0,                    // and padding to two bytes
    0xA1, 0x02, 0x85, 0x04, 0x05, 0x08, 0x09, 0x4B, 0x15, 0x00, 0x25, 0x01, 0x75, 0x01,  // report 4, out: the lamp
    0x95, 0x01, 0x91, 0x02, 0x95, 0x07, 0x91, 0x03, 0xC0, 0xC0};

void tell(int file, const uhid_event& event) {
  if (::write(file, &event, sizeof event) != static_cast<ssize_t>(sizeof event)) {
    throw std::runtime_error(std::string("/dev/uhid: cannot write: ") + std::strerror(errno));
  }
}

}  // namespace

UhidSpaceMouse::UhidSpaceMouse() : file_(::open("/dev/uhid", O_RDWR | O_CLOEXEC | O_NONBLOCK)) {
  if (file_ < 0) throw std::runtime_error(std::string("/dev/uhid: ") + std::strerror(errno));
  uhid_event event{};
  event.type = UHID_CREATE2;
  std::snprintf(reinterpret_cast<char*>(event.u.create2.name), sizeof event.u.create2.name,
                "3Dconnexion SpaceMouse Compact");
  event.u.create2.rd_size = kDescriptor.size();
  std::copy(kDescriptor.begin(), kDescriptor.end(), static_cast<std::uint8_t*>(event.u.create2.rd_data));
  event.u.create2.bus = 3;  // USB
  event.u.create2.vendor = 0x256F;
  event.u.create2.product = 0xC635;
  tell(file_, event);
}

UhidSpaceMouse::~UhidSpaceMouse() {
  unplug();
}

void UhidSpaceMouse::send(const std::vector<std::uint8_t>& report) const {
  uhid_event event{};
  event.type = UHID_INPUT2;
  event.u.input2.size = static_cast<std::uint16_t>(report.size());
  std::copy(report.begin(), report.end(), event.u.input2.data);
  tell(file_, event);
}

std::vector<std::vector<std::uint8_t>> UhidSpaceMouse::outputs() const {
  std::vector<std::vector<std::uint8_t>> reports;
  for (uhid_event event{}; ::read(file_, &event, sizeof event) > 0;) {
    if (event.type != UHID_OUTPUT) continue;
    const std::uint8_t* data = event.u.output.data;
    reports.emplace_back(data, data + event.u.output.size);
  }
  return reports;
}

void UhidSpaceMouse::unplug() {
  if (file_ >= 0) ::close(file_);
  file_ = -1;
}

}  // namespace myotact::device::spacemouse
