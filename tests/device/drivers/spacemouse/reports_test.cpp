#include "device/drivers/spacemouse/reports.h"

#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "messages/device.h"

namespace myotact::device::spacemouse {
namespace {

using ::testing::ElementsAre;
using Bytes = std::vector<std::uint8_t>;

TEST(SpaceMouseReports, PushAndTurnComeInTwoReportsOfThreeNumbers) {
  Cap cap;
  ASSERT_TRUE(apply_report(Bytes{0x01, 0x5E, 0x01, 0xA2, 0xFE, 0x00, 0x00}, cap));
  EXPECT_THAT(cap.push, ElementsAre(350, -350, 0));
  EXPECT_THAT(cap.rotation, ElementsAre(0, 0, 0));
  ASSERT_TRUE(apply_report(Bytes{0x02, 0x01, 0x00, 0xFF, 0xFF, 0x10, 0x00}, cap));
  EXPECT_THAT(cap.push, ElementsAre(350, -350, 0));
  EXPECT_THAT(cap.rotation, ElementsAre(1, -1, 16));
}

TEST(SpaceMouseReports, OrInOneReportThatIsToldByItsLength) {
  Cap cap;
  ASSERT_TRUE(apply_report(Bytes{0x01, 1, 0, 2, 0, 3, 0, 4, 0, 5, 0, 6, 0}, cap));
  EXPECT_THAT(cap.push, ElementsAre(1, 2, 3));
  EXPECT_THAT(cap.rotation, ElementsAre(4, 5, 6));
  ASSERT_TRUE(apply_report(Bytes{0x01, 9, 0, 9, 0, 9, 0, 7, 0, 7, 0, 7}, cap));  // a byte short: push alone
  EXPECT_THAT(cap.push, ElementsAre(9, 9, 9));
  EXPECT_THAT(cap.rotation, ElementsAre(4, 5, 6));
}

TEST(SpaceMouseReports, NumbersBeyondFullDeflectionAreCutOff) {
  Cap cap;
  ASSERT_TRUE(apply_report(Bytes{0x01, 0xFF, 0x7F, 0x00, 0x80, 0x5F, 0x01}, cap));
  EXPECT_THAT(cap.push, ElementsAre(350, -350, 350));
}

TEST(SpaceMouseReports, KeysAndBatteryAreKept) {
  Cap cap;
  ASSERT_TRUE(apply_report(Bytes{0x03, 0x01}, cap));
  EXPECT_EQ(cap.keys, 1U);
  ASSERT_TRUE(apply_report(Bytes{0x03, 0x00, 0x10, 0x40, 0x02, 0xFF, 0xFF}, cap));
  EXPECT_EQ(cap.keys, bit_of(Key::One) | bit_of(Key::Escape) | bit_of(Key::Control));
  EXPECT_EQ(cap.battery_percent, -1);
  ASSERT_TRUE(apply_report(Bytes{0x17, 0x3C}, cap));
  EXPECT_EQ(cap.battery_percent, 60);
  ASSERT_TRUE(apply_report(Bytes{0x17, 0xFF}, cap));
  EXPECT_EQ(cap.battery_percent, 100);
}

TEST(SpaceMouseReports, WhatIsShortOrUnknownChangesNothing) {
  Cap cap;
  cap.push = {1, 2, 3};
  EXPECT_FALSE(apply_report(Bytes{}, cap));
  EXPECT_FALSE(apply_report(Bytes{0x01}, cap));
  EXPECT_FALSE(apply_report(Bytes{0x01, 1, 0, 2, 0, 3}, cap));
  EXPECT_FALSE(apply_report(Bytes{0x02, 1, 0, 2, 0, 3}, cap));
  EXPECT_FALSE(apply_report(Bytes{0x42, 1, 0, 2, 0, 3, 0}, cap));
  EXPECT_THAT(cap.push, ElementsAre(1, 2, 3));
}

TEST(SpaceMouseReports, RandomBytesNeverLeaveTheRange) {
  std::mt19937 random(20261123);
  Cap cap;
  for (int i = 0; i < 200'000; ++i) {
    Bytes report(random() % 70);
    for (auto& byte : report) byte = static_cast<std::uint8_t>(random());
    if (!report.empty() && i % 2 == 0) report[0] = static_cast<std::uint8_t>(1 + random() % 3);
    apply_report(report, cap);
    for (const auto& axes : {cap.push, cap.rotation}) {
      for (const int axis : axes) ASSERT_LE(std::abs(axis), kFullDeflection);
    }
    ASSERT_LE(cap.battery_percent, 100);
  }
}

TEST(SpaceMouseReports, KeysBecomeButtonsByTheirMeaning) {
  EXPECT_EQ(stylus_buttons(0b01), messages::kGrabButton);
  EXPECT_EQ(stylus_buttons(0b10), messages::kGrabBoneButton);
  EXPECT_EQ(stylus_buttons(bit_of(Key::One) | bit_of(Key::Two)), messages::kGrabButton | messages::kGrabBoneButton);
  EXPECT_EQ(stylus_buttons(bit_of(Key::Escape)), messages::kStopButton);
  // Bit 2 would be the emergency stop if bits were passed on.
  EXPECT_EQ(stylus_buttons(bit_of(Key::Top) | bit_of(Key::Right) | bit_of(Key::Lock)), 0U);
}

TEST(SpaceMouseReports, TheLightIsSwitchedByTwoBytes) {
  EXPECT_THAT(light_report(true), ElementsAre(4, 1));
  EXPECT_THAT(light_report(false), ElementsAre(4, 0));
}

}  // namespace
}  // namespace myotact::device::spacemouse
