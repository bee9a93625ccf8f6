// The drivers against the kernel's own USB and HID stacks; runs as root in a virtual machine (tools/test-usb-in-vm.sh).
// States are waited for, as an emulated processor takes its time; each check prints a line.

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

#include "core/error.h"
#include "device/drivers/falcon/falcon_driver.h"
#include "device/drivers/spacemouse/spacemouse_driver.h"
#include "realtime/periodic_loop.h"
#include "uhid_spacemouse.h"
#include "usbip_falcon.h"

namespace {

using namespace myotact;
using device::DevicePhase;
using device::HardwareDevice;

int failed = 0;

void check(const char* what, bool is_right) {
  std::printf("%-70s %s\n", what, is_right ? "ok" : "FAILED");
  std::fflush(stdout);
  failed += is_right ? 0 : 1;
}

bool becomes_true(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (std::chrono::steady_clock::now() < end) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}

/// A tick with one newton upwards.
messages::DeviceState tick(HardwareDevice& device) {
  const messages::DeviceState state = device.read(realtime::steady_now_ns());
  device.write({{0.0, 1.0, 0.0}});
  return state;
}

/// As the maker's in size and beginning alone.
std::filesystem::path write_image() {
  const std::filesystem::path file = "/tmp/image.bin";
  std::string bytes(8000, '\x5a');
  bytes[0] = '\xaa';
  bytes[1] = '\x08';
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

void check_falcon() {
  using device::falcon::FakeFalcon;
  device::falcon::FalconSettings settings;
  settings.firmware = write_image();
  device::falcon::FalconDriver driver(settings);
  check("falcon: without one, none is found", !driver.find().front().ready);
  auto falcon = std::make_unique<device::falcon::UsbipFalcon>();
  check("falcon: the kernel enumerates it, libusb finds it", becomes_true([&] { return driver.find().front().ready; }));
  const auto device = driver.make("falcon");
  device->open();
  check("falcon: its firmware was uploaded, every block echoed",
        falcon->with([](FakeFalcon& fake) { return fake.uploaded().size() == 8000u; }));
  check("falcon: wants to be homed, and pushes not",
        becomes_true([&] { return tick(*device), device->report().phase == DevicePhase::NeedsCalibration; }) &&
            falcon->with([](FakeFalcon& fake) { return fake.force_N(4000.0).norm() == 0.0; }));
  const auto other = driver.find();
  check("falcon: a second opener is told that it is in use", !other.front().ready);
  std::printf("        (%s)\n", other.front().cause.c_str());
  falcon->with([](FakeFalcon& fake) { fake.home(); });
  check("falcon: homed, it is felt", becomes_true([&] {
          tick(*device);
          return device->connected() && falcon->with([](FakeFalcon& fake) { return fake.force_N(4000.0).y() > 0.9; });
        }));
  const int before = falcon->with([](FakeFalcon& fake) { return fake.commands(); });
  check("falcon: five hundred more exchanges", becomes_true([&] {
          tick(*device);
          return falcon->with([&](FakeFalcon& fake) { return fake.commands() > before + 500; });
        }));
  falcon->unplug();
  check("falcon: unplugged, it is lost", becomes_true([&] {
          return tick(*device), device->report().phase == DevicePhase::Lost && !device->connected();
        }));
  falcon = std::make_unique<device::falcon::UsbipFalcon>();
  check("falcon: plugged in again it starts anew, unhomed",
        becomes_true([&] { return tick(*device), device->report().phase == DevicePhase::NeedsCalibration; }));
  device->close();
  check("falcon: closed", device->report().phase == DevicePhase::Closed);
}

void check_spacemouse() {
  device::spacemouse::SpaceMouseDriver driver;
  check("spacemouse: without one, none is found", !driver.find().front().ready);
  auto mouse = std::make_unique<device::spacemouse::UhidSpaceMouse>();
  check("spacemouse: the kernel's HID stack has it, hidapi finds it",
        becomes_true([&] { return driver.find().front().ready; }));
  std::printf("        (%s)\n", driver.find().front().title.c_str());
  const auto device = driver.make("spacemouse");
  device->open();
  bool lamp_on = false;
  const auto look_at_lamp = [&] {
    for (const auto& report : mouse->outputs()) lamp_on = report.size() >= 2 && report[0] == 4 && report[1] == 1;
    return lamp_on;
  };
  check("spacemouse: its lamp is switched on by an output report", becomes_true(look_at_lamp));
  mouse->send({1, 0x5E, 0x01, 0, 0, 0, 0});  // pushed to the right as far as it goes
  check("spacemouse: a push moves the tool to the right",
        becomes_true([&] { return tick(*device).stylus_position_world_m[0] > 0.005; }));
  mouse->send({1, 0, 0, 0, 0, 0, 0});
  mouse->send({3, 1, 0});
  check("spacemouse: its left button takes hold",
        becomes_true([&] { return tick(*device).buttons == messages::kGrabButton; }));
  mouse->unplug();
  check("spacemouse: unplugged, it is lost",
        becomes_true([&] { return tick(*device), device->report().phase == DevicePhase::Lost; }));
  mouse = std::make_unique<device::spacemouse::UhidSpaceMouse>();
  check("spacemouse: plugged in again, it is ready",
        becomes_true([&] { return tick(*device), device->report().phase == DevicePhase::Ready; }));
  device->close();
}

}  // namespace

int main() {
  try {
    check_falcon();
    check_spacemouse();
  } catch (const std::exception& error) {
    std::printf("FAILED: %s\n", error.what());
    ++failed;
  }
  std::printf("%s\n", failed == 0 ? "every check passed" : "CHECKS FAILED");
  return failed == 0 ? 0 : 1;
}
