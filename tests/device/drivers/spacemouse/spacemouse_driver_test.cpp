#include "device/drivers/spacemouse/spacemouse_driver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "device/drivers/spacemouse/fake_hid.h"
#include "device/drivers/spacemouse/models.h"

namespace myotact::device::spacemouse {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

HidEntry entry_of(std::uint16_t vendor, std::uint16_t product, std::uint16_t page = 1, std::uint16_t usage = 8) {
  HidEntry entry = compact("/dev/hidraw0");
  entry.vendor = vendor;
  entry.product = product;
  entry.usage_page = page;
  entry.usage = usage;
  return entry;
}

TEST(SpaceMouseModels, TheCapIsTakenAndOtherInterfacesAndProductsAreNot) {
  EXPECT_TRUE(is_cap(entry_of(0x256F, 0xC635)));
  EXPECT_TRUE(is_cap(entry_of(0x256F, 0xC652)));
  EXPECT_TRUE(is_cap(entry_of(0x046D, 0xC626)));
  EXPECT_FALSE(is_cap(entry_of(0x256F, 0xC652, 1, 2))) << "the mouse interface of a receiver";
  EXPECT_FALSE(is_cap(entry_of(0x256F, 0xC652, 0xFF00, 8))) << "a page of the maker's own";
  EXPECT_FALSE(is_cap(entry_of(0x046D, 0xC077))) << "an ordinary mouse";
  EXPECT_FALSE(is_cap(entry_of(0x1234, 0xC635))) << "another maker";
  for (const int product :
       {0xC650, 0xC651, 0xC654, 0xC655, 0xC656, 0xC657, 0xC658, 0xC664, 0xC665, 0xC668, 0xC62C, 0xC641}) {
    EXPECT_FALSE(is_cap(entry_of(0x256F, static_cast<std::uint16_t>(product)))) << product;
  }
}

class SpaceMouseFinding : public ::testing::Test {
 protected:
  std::shared_ptr<FakeBus> bus_ = std::make_shared<FakeBus>();
  SpaceMouseDriver driver_{{}, bus_};
};

TEST_F(SpaceMouseFinding, NothingPluggedInIsOneRowThatSaysSo) {
  const auto findings = driver_.find();
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].name, "spacemouse");
  EXPECT_FALSE(findings[0].ready);
  EXPECT_EQ(findings[0].cause, "no SpaceMouse is plugged in");
  EXPECT_FALSE(findings[0].remedy.empty());
  EXPECT_THROW(driver_.make("spacemouse"), Error);
}

TEST_F(SpaceMouseFinding, TwoAreNamedByTheOrderOfTheirPaths) {
  bus_->plug(compact("/dev/hidraw5"));
  HidEntry pro = entry_of(0x046D, 0xC62B);
  pro.path = "/dev/hidraw2";
  pro.serial = "A7";
  bus_->plug(pro);
  bus_->plug(entry_of(0x256F, 0xC650));
  const auto findings = driver_.find();
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_EQ(findings[0].name, "spacemouse");
  EXPECT_EQ(findings[0].title, "3Dconnexion SpaceMouse Pro A7");
  EXPECT_EQ(findings[1].name, "spacemouse:2");
  EXPECT_EQ(findings[1].title, "3Dconnexion SpaceMouse Compact");
  EXPECT_TRUE(findings[0].ready && findings[1].ready);
  EXPECT_THAT(findings[0].cause, IsEmpty());

  const auto second = driver_.make("spacemouse:2");
  EXPECT_EQ(second->name(), "spacemouse:2");
  second->open();
  EXPECT_TRUE(second->connected());
  EXPECT_THROW(driver_.make("spacemouse:3"), Error);
}

TEST_F(SpaceMouseFinding, OneLeftOfTwoIsNotTakenForTheOther) {
  bus_->plug(compact("/dev/hidraw1"));
  bus_->plug(compact("/dev/hidraw2"));
  const auto first = driver_.make("spacemouse");
  bus_->unplug_all();
  bus_->plug(compact("/dev/hidraw2"));
  EXPECT_THROW(first->open(), Error);
}

TEST_F(SpaceMouseFinding, WithoutPermissionTheUdevRuleIsNamed) {
  HidEntry entry = compact("/dev/hidraw1");
  entry.may_open = false;
  bus_->plug(entry);
  const auto findings = driver_.find();
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_FALSE(findings[0].ready);
  EXPECT_THAT(findings[0].cause, HasSubstr("/dev/hidraw1"));
  EXPECT_THAT(findings[0].remedy, HasSubstr("assets/devices/udev/70-myotact.rules"));
  EXPECT_THROW(driver_.make("spacemouse"), Error);
}

}  // namespace
}  // namespace myotact::device::spacemouse
