// The driver behind the real libusb: umockdev shows it a bus with a Falcon on it and answers what it asks the kernel.
// States are waited for, with generous limits; no time decides.

#include <cmath>
#include <filesystem>
#include <iostream>
#include <random>
#include <thread>

#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <libusb.h>

#include "core/error.h"
#include "core/file.h"
#include "device/drivers/falcon/falcon_driver.h"
#include "device/drivers/falcon/firmware.h"
#include "device/drivers/falcon/session.h"
#include "realtime/periodic_loop.h"
#include "support/source_folder.h"
#include "support/temporary_folder.h"
#include "usbfs_falcon.h"

namespace {

bool may_open = true;  // of this user: what libusb answers when the kernel refuses

}  // namespace

// In place of libusb's own for the whole program, as root may open everything.
extern "C" int LIBUSB_CALL libusb_open(libusb_device* device, libusb_device_handle** handle) {
  using Open = int (*)(libusb_device*, libusb_device_handle**);
  static const auto real = reinterpret_cast<Open>(dlsym(RTLD_NEXT, "libusb_open"));
  return may_open ? real(device, handle) : static_cast<int>(LIBUSB_ERROR_ACCESS);
}

namespace myotact::device::falcon {
namespace {

using ::testing::HasSubstr;

constexpr double kCountsPerNm = ExchangeSettings{}.counts_per_Nm;

std::uint64_t steady(void*) {
  return realtime::steady_now_ns();
}

std::vector<std::uint8_t> some_image() {
  std::vector<std::uint8_t> image(8000);
  std::mt19937 random(5);
  for (std::uint8_t& byte : image) byte = static_cast<std::uint8_t>(random());
  image[0] = 0xaa;
  image[1] = 0x08;
  return image;
}

class FalconUsb : public ::testing::Test {
 protected:
  void SetUp() override {
    falcon = std::make_unique<UsbfsFalcon>();
    if (!umockdev_in_mock_environment()) GTEST_SKIP() << "run by umockdev-wrapper";
  }
  void TearDown() override { may_open = true; }
  double felt_N() {
    return falcon->with([](FakeFalcon& fake) { return fake.force_N(kCountsPerNm).norm(); });
  }
  void set(Fault fault) {
    falcon->with([fault](FakeFalcon& fake) { fake.set(fault); });
  }

  std::unique_ptr<UsbfsFalcon> falcon;
  std::shared_ptr<UsbBus> bus = make_libusb_bus();
};

TEST_F(FalconUsb, IsFoundWhileItIsPluggedIn) {
  FalconDriver driver;
  EXPECT_FALSE(driver.find().at(0).ready);
  falcon->plug();
  const auto findings = driver.find();
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_TRUE(findings[0].ready) << findings[0].cause;
  EXPECT_EQ(findings[0].name, "falcon");
  EXPECT_EQ(findings[0].title, "Novint Falcon at USB 1-1");
  falcon->unplug();
  EXPECT_FALSE(driver.find().at(0).ready);
}

TEST_F(FalconUsb, OneThatAnotherProgramHasIsSaidToBeInUse) {
  falcon->plug();
  falcon->let_another_have_it(true);
  const auto findings = FalconDriver().find();
  EXPECT_FALSE(findings.at(0).ready);
  EXPECT_THAT(findings[0].cause, HasSubstr("/dev/bus/usb/001/002: another program uses it"));
  EXPECT_THROW(FalconDriver().make("falcon"), Error);
  EXPECT_THROW(bus->open("1-1"), Error);
  falcon->let_another_have_it(false);
  EXPECT_TRUE(FalconDriver().find().at(0).ready);
}

TEST_F(FalconUsb, OneThatThisUserMayNotOpenNamesTheRule) {
  falcon->plug();
  may_open = false;
  const auto findings = FalconDriver().find();
  EXPECT_FALSE(findings.at(0).ready);
  EXPECT_THAT(findings[0].cause, HasSubstr("/dev/bus/usb/001/002: this user may not"));
  EXPECT_THAT(findings[0].remedy, HasSubstr("assets/devices/udev/70-myotact.rules"));
  EXPECT_TRUE(std::filesystem::exists(source_folder() + "/assets/devices/udev/70-myotact.rules"));
}

/// A Falcon that runs and is homed, its turns made by the test.
class FalconUsbTurns : public FalconUsb {
 protected:
  void SetUp() override {
    FalconUsb::SetUp();
    if (IsSkipped()) return;
    falcon->plug();
    falcon->with([](FakeFalcon& fake) {
      fake.boot_with_firmware();
      fake.home();
    });
    transport = bus->open("1-1");
    start_firmware(*transport, {});
    session = std::make_unique<Session>(*transport, ExchangeSettings{}, steady, nullptr);
    ASSERT_TRUE(turns_until([this] { return phase() == DevicePhase::Ready; }));
  }
  void turns(int count) {
    for (int i = 0; i < count; ++i) session->exchange_once({{0.0, 1.0, 0.0}, session->now_ns()});
  }
  DevicePhase phase() const { return session->exchange().phase(session->now_ns()); }
  /// Turns until it is so, at most ten thousand.
  template <typename Condition>
  bool turns_until(Condition condition) {
    for (int i = 0; i < 10'000; ++i) {
      if (condition()) return true;
      turns(1);
    }
    return false;
  }

  std::unique_ptr<Transport> transport;
  std::unique_ptr<Session> session;
};

TEST_F(FalconUsbTurns, TenThousandAreFelt) {
  const std::uint64_t begin_ns = session->now_ns(), before = session->reports();
  turns(10'000);
  const double taken_s = 1e-9 * static_cast<double>(session->now_ns() - begin_ns);
  const auto reports = static_cast<double>(session->reports() - before);
  std::cout << "through libusb and umockdev: " << reports / taken_s << " reports a second\n";
  EXPECT_GE(reports, 9'900) << "a turn without a report waited five milliseconds for it: the machine was busy";
  EXPECT_TRUE(turns_until([&] { return phase() == DevicePhase::Ready && std::abs(felt_N() - 1.0) < 0.01; }));
  EXPECT_GE(falcon->most_queued(), 2u);
}

TEST_F(FalconUsbTurns, PacketsInPartsInPairsAndBehindGarbageAreRead) {
  for (const Fault fault : {Fault::Split, Fault::TwoAtOnce, Fault::GarbageBefore}) {
    set(fault);
    const std::uint64_t before = session->reports();
    EXPECT_TRUE(turns_until([&] { return session->reports() >= before + 500; })) << static_cast<int>(fault);
    EXPECT_TRUE(turns_until([&] { return phase() == DevicePhase::Ready && felt_N() > 0.9; }));
  }
}

TEST_F(FalconUsbTurns, SilenceTakesTheForceAndSpeechGivesItBack) {
  for (const Fault fault : {Fault::NoReply, Fault::StatusOnly}) {
    set(fault);
    EXPECT_TRUE(turns_until([&] { return phase() != DevicePhase::Ready && felt_N() == 0.0; }))
        << static_cast<int>(fault);
    set(Fault::None);
    EXPECT_TRUE(turns_until([&] { return phase() == DevicePhase::Ready && felt_N() > 0.9; }));
  }
}

TEST_F(FalconUsbTurns, WhatItDoesNotTakeIsTakenBackAndNeverPushesLate) {
  set(Fault::Stall);
  EXPECT_TRUE(turns_until([&] { return phase() != DevicePhase::Ready; }));
  const auto commands = [this] { return falcon->with([](FakeFalcon& fake) { return fake.commands(); }); };
  const int before = commands();
  set(Fault::None);
  EXPECT_TRUE(turns_until([&] { return commands() > before; }));
  EXPECT_EQ(falcon->with([](FakeFalcon& fake) { return fake.last_command().motor_counts; }),
            (std::array<std::int16_t, 3>{}))
      << "the first that it takes again is without force";
  EXPECT_TRUE(turns_until([&] { return phase() == DevicePhase::Ready && felt_N() > 0.9; }));
}

TEST_F(FalconUsbTurns, AnEndpointThatStallsIsCleared) {
  falcon->stall_in();
  EXPECT_TRUE(turns_until([&] { return falcon->cleared_halts() == 1; }));
  EXPECT_TRUE(turns_until([&] { return phase() == DevicePhase::Ready && felt_N() > 0.9; }));
  falcon->stall_out();
  EXPECT_TRUE(turns_until([&] { return falcon->cleared_halts() == 2; }));
  EXPECT_TRUE(turns_until([&] { return phase() == DevicePhase::Ready && felt_N() > 0.9; }));
}

TEST_F(FalconUsbTurns, LeapsAndLegsThatForgetTheirStopTakeTheForce) {
  for (const Fault fault : {Fault::HomedDrops, Fault::EncoderLeaps}) {
    set(fault);
    // That two turns are enough is shown on a virtual clock; here a busy machine may answer late.
    EXPECT_TRUE(turns_until([&] { return phase() != DevicePhase::Ready && felt_N() == 0.0; }))
        << static_cast<int>(fault);
    set(Fault::None);
    EXPECT_TRUE(turns_until([&] { return phase() == DevicePhase::Ready && felt_N() > 0.9; }));
  }
}

TEST_F(FalconUsbTurns, AnUnpluggedOneIsGone) {
  falcon->unplug();
  EXPECT_TRUE(turns_until([&] { return transport->is_gone(); }));
  EXPECT_FALSE(transport->send(encode(Command{})));
  EXPECT_FALSE(transport->request(0, 1));
}

TEST_F(FalconUsbTurns, TheLastCommandArrivesBeforeItIsClosed) {
  EXPECT_TRUE(turns_until([&] { return felt_N() > 0.9; }));
  session->rest();
  transport.reset();
  EXPECT_EQ(felt_N(), 0.0);
  EXPECT_TRUE(FalconDriver().find().at(0).ready) << "and it is free again";
}

TEST_F(FalconUsb, TheWholeDriverUploadsHomesIsFeltAndComesBack) {
  falcon->plug();
  const testing::TemporaryFolder folder;
  FalconSettings settings;
  settings.firmware = folder / "image.bin";
  const std::vector<std::uint8_t> image = some_image();
  write_file(settings.firmware, std::string(image.begin(), image.end()));
  FalconDriver driver(settings);
  const auto device = driver.make("falcon");
  const auto ticks_until = [&](auto condition) {
    for (int tick = 0; tick < 60'000; ++tick) {
      device->read(realtime::steady_now_ns());
      device->write({{0.0, 1.0, 0.0}});
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  };
  const auto in = [&](DevicePhase phase) { return [&, phase] { return device->report().phase == phase; }; };
  device->open();
  for (int time = 0; time < 2; ++time) {
    EXPECT_TRUE(ticks_until(in(DevicePhase::NeedsCalibration)));
    EXPECT_EQ(felt_N(), 0.0);
    EXPECT_EQ(falcon->with([](FakeFalcon& fake) { return fake.uploaded(); }), image);
    falcon->with([](FakeFalcon& fake) { fake.home(); });
    EXPECT_TRUE(ticks_until([&] { return device->connected() && felt_N() > 0.9; }));
    if (time == 1) break;
    falcon->unplug();
    EXPECT_TRUE(ticks_until(in(DevicePhase::Lost)));
    EXPECT_TRUE(ticks_until([&] { return !device->connected(); }));
    falcon->with([](FakeFalcon& fake) { fake.lose_power(); });
    falcon->plug();
  }
  EXPECT_TRUE(ticks_until([&] { return device->report().rate_Hz > 0.0; }));
  device->close();
  EXPECT_EQ(felt_N(), 0.0);
}

}  // namespace
}  // namespace myotact::device::falcon
