#include "device/drivers/falcon/falcon_driver.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "device/profile_file.h"
#include "fake_falcon.h"

namespace myotact::device::falcon {
namespace {

using ::testing::HasSubstr;

/// A bus as the test wants it, with running Falcons.
class FakeBus : public UsbBus {
 public:
  UsbListing list() override { return listing; }
  std::unique_ptr<Transport> open(const std::string& place) override {
    opened.push_back(place);
    auto fake = std::make_unique<FakeFalcon>();
    fake->boot_with_firmware();
    return fake;
  }

  UsbListing listing;
  std::vector<std::string> opened;
};

struct Rig {
  std::shared_ptr<FakeBus> bus = std::make_shared<FakeBus>();
  FalconDriver driver{{}, bus};

  std::string refusal(const std::string& name) {
    try {
      driver.make(name)->open();
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::Unavailable);
      return error.what();
    }
    return "no error";
  }
};

TEST(FalconDriver, NothingPluggedInIsOneRowThatSaysSo) {
  Rig rig;
  const auto findings = rig.driver.find();
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_FALSE(findings[0].ready);
  EXPECT_EQ(findings[0].name, "falcon");
  EXPECT_NE(findings[0].cause, "");
  EXPECT_NE(findings[0].remedy, "");
  EXPECT_THAT(rig.refusal("falcon"), HasSubstr(findings[0].cause));
}

TEST(FalconDriver, WithoutUsbTheRowSaysWhy) {
  Rig rig;
  rig.bus->listing.trouble = {"there is no USB", "bring some"};
  const auto findings = rig.driver.find();
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_FALSE(findings[0].ready);
  EXPECT_EQ(findings[0].cause, "there is no USB");
  EXPECT_EQ(findings[0].remedy, "bring some");
}

TEST(FalconDriver, EachHasItsNameAndItsOwnTrouble) {
  Rig rig;
  rig.bus->listing.falcons = {{"1-1", {"busy", "wait"}}, {"1-2", {}}};
  const auto findings = rig.driver.find();
  ASSERT_EQ(findings.size(), 2u);
  EXPECT_FALSE(findings[0].ready);
  EXPECT_EQ(findings[0].cause, "busy");
  EXPECT_TRUE(findings[1].ready);
  EXPECT_EQ(findings[1].name, "falcon:2");
  EXPECT_THAT(rig.refusal("falcon"), HasSubstr("falcon: busy; wait"));
  EXPECT_THAT(rig.refusal("falcon:3"), HasSubstr("falcon:2"));
  EXPECT_EQ(rig.refusal("falcon:2"), "no error");
  EXPECT_EQ(rig.bus->opened, std::vector<std::string>{"1-2"});
}

TEST(FalconDriver, OfTwoTheOneThatIsLeftIsNotTakenForTheOther) {
  Rig rig;
  rig.bus->listing.falcons = {{"1-1", {}}, {"1-2", {}}};
  const auto device = rig.driver.make("falcon");
  rig.bus->listing.falcons = {{"1-2", {}}};
  EXPECT_THROW(device->open(), Error);
  EXPECT_TRUE(rig.bus->opened.empty());
}

TEST(FalconDriver, InAnotherSocketItIsTheOneThatWasNotThere) {
  Rig rig;
  rig.bus->listing.falcons = {{"1-1", {}}, {"1-2", {}}};
  const auto device = rig.driver.make("falcon");
  rig.bus->listing.falcons = {{"1-2", {}}, {"1-3", {}}};
  device->open();
  EXPECT_EQ(rig.bus->opened, std::vector<std::string>{"1-3"});
}

TEST(FalconDriver, TheDeviceHasTheProfileOfItsFile) {
  Rig rig;
  rig.bus->listing.falcons = {{"1-1", {}}};
  const auto device = rig.driver.make("falcon");
  const DeviceProfile& ours = device->profile();
  const DeviceProfile file = load_profile("falcon").profile;
  EXPECT_EQ(ours.peak_force_N, file.peak_force_N);
  EXPECT_EQ(ours.continuous_force_N, file.continuous_force_N);
  EXPECT_EQ(ours.max_stiffness_N_m, file.max_stiffness_N_m);
  EXPECT_EQ(ours.inertia_kg, file.inertia_kg);
  EXPECT_EQ(ours.viscous_Ns_m, file.viscous_Ns_m);
  EXPECT_EQ(ours.coulomb_N, file.coulomb_N);
  EXPECT_EQ(ours.resolution_m, file.resolution_m);
  EXPECT_EQ(ours.delay_ticks, file.delay_ticks);
  EXPECT_EQ(ours.workspace_m, file.workspace_m);
}

TEST(FalconDriver, ASystemThatShowsNoUsbIsNamed) {
  if (std::filesystem::exists("/dev/bus/usb")) GTEST_SKIP() << "this one shows its USB";
  const auto findings = FalconDriver().find();
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_FALSE(findings[0].ready);
  EXPECT_THAT(findings[0].cause, HasSubstr("/dev/bus/usb"));
  EXPECT_THROW(make_libusb_bus()->open("1-1"), Error);
}

}  // namespace
}  // namespace myotact::device::falcon
