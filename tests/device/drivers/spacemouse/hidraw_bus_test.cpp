// The driver behind the real hidapi-hidraw: umockdev shows it a sysfs and a /dev with a SpaceMouse Compact in them and
// answers reads, writes and ioctls of its node. Nothing here waits for a time: a script goes on only when the LED
// report that it expects was written.

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <umockdev.h>

#include "core/error.h"
#include "device/drivers/spacemouse/spacemouse_driver.h"
#include "support/temporary_folder.h"

namespace myotact::device::spacemouse {
namespace {

using ::testing::ElementsAre;

constexpr const char* kNode = "/dev/hidraw0";

/// The start of a report descriptor as the kernel gives it: a collection of usage page 1, usage 8 with six axes.
const std::vector<std::uint8_t> kDescriptor = {
    0x05, 0x01, 0x09, 0x08, 0xA1, 0x01,                                      // generic desktop, multi-axis controller
    0xA1, 0x00, 0x85, 0x01, 0x16, 0xA2, 0xFE, 0x26, 0x5E, 0x01,              // report 1, -350 .. 350
    0x09, 0x30, 0x09, 0x31, 0x09, 0x32, 0x75, 0x10, 0x95, 0x03, 0x81, 0x06,  // X Y Z, 16 bit
    0xC0, 0xA1, 0x00, 0x85, 0x02, 0x09, 0x33, 0x09, 0x34, 0x09, 0x35, 0x75, 0x10, 0x95, 0x03, 0x81, 0x06, 0xC0, 0xC0};

std::string hex(const std::vector<std::uint8_t>& bytes) {
  std::string digits;
  for (const std::uint8_t byte : bytes) digits += fmt::format("{:02X}", byte);
  return digits;
}

/// Bytes as a script has them.
std::string script_bytes(const std::vector<std::uint8_t>& bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    if (byte < 32) {
      text += {'^', static_cast<char>(byte + 64)};
    } else if (byte == '^') {
      text += "^`";
    } else {
      text += static_cast<char>(byte);
    }
  }
  return text;
}

/// hidraw, its HID parent and the USB device above, as `umockdev-record` writes them.
std::string record(const std::string& product) {
  const std::string usb = "/devices/pci0000:00/0000:00:14.0/usb1/1-2";
  const std::string hid = fmt::format("{}/1-2:1.0/0003:256F:{}.0001", usb, product);
  return fmt::format(
             "P: {}/hidraw/hidraw0\nN: hidraw0\nE: DEVNAME=/dev/hidraw0\nE: SUBSYSTEM=hidraw\n"
             "L: device=../../../0003:256F:{}.0001\n\n",
             hid, product) +
         fmt::format(
             "P: {}\nE: HID_ID=0003:0000256F:0000{}\nE: HID_NAME=3Dconnexion SpaceMouse Compact\nE: HID_UNIQ=\n"
             "E: SUBSYSTEM=hid\nH: report_descriptor={}\n\n",
             hid, product, hex(kDescriptor)) +
         fmt::format("P: {}/1-2:1.0\nE: DEVTYPE=usb_interface\nE: SUBSYSTEM=usb\nA: bInterfaceNumber=00\\n\n\n", usb) +
         fmt::format(
             "P: {}\nE: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\nA: manufacturer=3Dconnexion\\n\n"
             "A: product=SpaceMouse Compact\\nA: bcdDevice=0437\\n\n\n",
             usb);
}

class Hidraw : public ::testing::Test {
 protected:
  void SetUp() override {
    bed_ = umockdev_testbed_new();
    if (!umockdev_in_mock_environment()) GTEST_SKIP() << "run by umockdev-wrapper";
  }
  void TearDown() override {
    if (bed_ != nullptr) g_object_unref(bed_);
  }

  void plug(const std::string& product = "C635") {
    GError* error = nullptr;
    ASSERT_TRUE(umockdev_testbed_add_from_string(bed_, record(product).c_str(), &error)) << error->message;
  }

  void answer_ioctls() {
    std::vector<std::uint8_t> size(4, 0);
    size[0] = static_cast<std::uint8_t>(kDescriptor.size());
    std::vector<std::uint8_t> descriptor = size;
    descriptor.insert(descriptor.end(), kDescriptor.begin(), kDescriptor.end());
    descriptor.resize(4 + 4096, 0);
    const auto path = folder_.path() / "ioctl";
    std::ofstream(path) << "@DEV " << kNode << "\nHIDIOCGRDESCSIZE 0 " << hex(size) << "\nHIDIOCGRDESC 0 "
                        << hex(descriptor) << "\n";
    GError* error = nullptr;
    ASSERT_TRUE(umockdev_testbed_load_ioctl(bed_, kNode, path.c_str(), &error)) << error->message;
  }

  void play(const std::string& script) {
    const auto path = folder_.path() / "script";
    std::ofstream(path, std::ios::binary) << script;
    GError* error = nullptr;
    ASSERT_TRUE(umockdev_testbed_load_script(bed_, kNode, path.c_str(), &error)) << error->message;
  }

  static std::string device_takes(const std::vector<std::uint8_t>& bytes) {
    return "w 0 " + script_bytes(bytes) + "\n";
  }
  static std::string device_sends(const std::vector<std::uint8_t>& bytes) {
    return "r 0 " + script_bytes(bytes) + "\n";
  }

  testing::TemporaryFolder folder_;
  UMockdevTestbed* bed_ = nullptr;
};

std::vector<std::uint8_t> next_report(HidPort& port) {
  std::vector<std::uint8_t> report(kLongestReport);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  int length = 0;
  while (length == 0 && std::chrono::steady_clock::now() < end) {
    length = port.read(report);
    if (length == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  report.resize(static_cast<std::size_t>(std::max(length, 0)));
  return report;
}

TEST_F(Hidraw, WhatIsPluggedInIsListedWithItsUsage) {
  const auto bus = make_hidraw_bus();
  EXPECT_TRUE(bus->list().empty());
  plug();
  answer_ioctls();
  const auto entries = bus->list();
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_EQ(entries[0].path, kNode);
  EXPECT_EQ(entries[0].vendor, 0x256F);
  EXPECT_EQ(entries[0].product, 0xC635);
  EXPECT_EQ(entries[0].usage_page, 1);
  EXPECT_EQ(entries[0].usage, 8);
}

TEST_F(Hidraw, ReportsAreReadAndTheLightIsWritten) {
  plug();
  answer_ioctls();
  const std::vector<std::uint8_t> push = {0x01, 0x5E, 0x01, 0xA2, 0xFE, 0x00, 0x00};
  const std::vector<std::uint8_t> turn = {0x02, 0x01, 0x00, 0xFF, 0xFF, 0x20, 0x00};
  play(device_takes({4, 1}) + device_sends(push) + device_takes({4, 0}) + device_sends(turn));
  const auto bus = make_hidraw_bus();
  const auto port = bus->open(kNode);
  std::vector<std::uint8_t> none(kLongestReport);
  EXPECT_EQ(port->read(none), 0) << "never waits";
  EXPECT_TRUE(port->write(light_report(true)));
  EXPECT_EQ(next_report(*port), push);
  EXPECT_TRUE(port->write(light_report(false)));
  EXPECT_EQ(next_report(*port), turn);
}

TEST_F(Hidraw, TheWholeDriverMovesATool) {
  plug();
  answer_ioctls();
  play(device_takes({4, 1}) + device_sends({0x01, 0x5E, 0x01, 0x00, 0x00, 0x00, 0x00}) + device_takes({4, 0}));
  SpaceMouseDriver driver;
  const auto findings = driver.find();
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_TRUE(findings[0].ready) << findings[0].cause;
  EXPECT_EQ(findings[0].title, "3Dconnexion SpaceMouse Compact");
  const auto device = driver.make("spacemouse");
  device->open();
  std::uint64_t now_ns = 0;
  messages::DeviceState state;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (state.stylus_position_world_m[0] < 0.05 && std::chrono::steady_clock::now() < end) {
    state = device->read(now_ns += 1'000'000);
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
  EXPECT_GE(state.stylus_position_world_m[0], 0.05);
  EXPECT_TRUE(device->connected());
  device->close();
}

TEST_F(Hidraw, AMouseOfTheSameMakerIsNoSpaceMouse) {
  plug("C650");
  answer_ioctls();
  const auto findings = SpaceMouseDriver().find();
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_FALSE(findings[0].ready);
}

TEST_F(Hidraw, ANodeThatIsGoneIsAnError) {
  EXPECT_THROW(make_hidraw_bus()->open(kNode), Error);
}

}  // namespace
}  // namespace myotact::device::spacemouse
