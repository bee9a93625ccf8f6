// The driver behind the real libusb: umockdev shows it a bus with a Falcon on it and answers what it asks the kernel.
// States are waited for, with generous limits; no time decides.

#include <fstream>
#include <iostream>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "device/drivers/falcon/falcon_driver.h"
#include "device/drivers/falcon/firmware.h"
#include "device/drivers/falcon/session.h"
#include "realtime/periodic_loop.h"
#include "support/temporary_folder.h"
#include "usbfs_falcon.h"

namespace myotact::device::falcon {
namespace {

using ::testing::HasSubstr;

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

class Usb : public ::testing::Test {
 protected:
  void SetUp() override {
    falcon = std::make_unique<UsbfsFalcon>();
    if (!umockdev_in_mock_environment()) GTEST_SKIP() << "run by umockdev-wrapper";
  }
  double felt_N() {
    return falcon->with([](FakeFalcon& fake) { return fake.force_N(ExchangeSettings{}.counts_per_Nm).norm(); });
  }

  std::unique_ptr<UsbfsFalcon> falcon;
  std::shared_ptr<UsbBus> bus = make_libusb_bus();
};

TEST_F(Usb, AFalconIsFoundWhileItIsPluggedIn) {
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

TEST_F(Usb, OneThatAnotherProgramHasIsSaidToBeInUse) {
  falcon->plug();
  falcon->let_another_have_it(true);
  const auto findings = FalconDriver().find();
  EXPECT_FALSE(findings.at(0).ready);
  EXPECT_THAT(findings[0].cause, HasSubstr("/dev/bus/usb/001/002: another program uses it"));
  EXPECT_THROW(FalconDriver().make("falcon"), Error);
  falcon->let_another_have_it(false);
  EXPECT_TRUE(FalconDriver().find().at(0).ready);
}

TEST_F(Usb, AnImageIsUploadedWhole) {
  falcon->plug();
  const auto transport = bus->open("1-1");
  start_firmware(*transport, some_image());
  EXPECT_EQ(falcon->with([](FakeFalcon& fake) { return fake.uploaded(); }), some_image());
}

TEST_F(Usb, TenThousandTurnsHomedAndFelt) {
  falcon->plug();
  falcon->with([](FakeFalcon& fake) { fake.boot_with_firmware(), fake.home(); });
  const auto transport = bus->open("1-1");
  start_firmware(*transport, {});
  Session session(*transport, {}, steady, nullptr);
  const std::uint64_t begin_ns = session.now_ns();
  constexpr int kTurns = 10'000;
  for (int i = 0; i < kTurns; ++i) session.turn({{0.0, 1.0, 0.0}, session.now_ns()});
  const double taken_s = 1e-9 * static_cast<double>(session.now_ns() - begin_ns);
  std::cout << "rate through umockdev: " << static_cast<double>(session.reports()) / taken_s << " reports/s\n";
  EXPECT_GE(session.reports(), static_cast<std::uint64_t>(kTurns * 99 / 100));
  EXPECT_EQ(session.exchange().phase(session.now_ns()), DevicePhase::Ready);
  EXPECT_NEAR(felt_N(), 1.0, 0.01);
  EXPECT_GE(falcon->most_queued(), 2u) << "transfers queued at once";
}

}  // namespace
}  // namespace myotact::device::falcon
