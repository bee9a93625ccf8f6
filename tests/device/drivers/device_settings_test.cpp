#include "device/drivers/device_settings.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/file.h"
#include "device/drivers/driver_table.h"
#include "support/temporary_folder.h"

namespace myotact::device {
namespace {

using myotact::testing::TemporaryFolder;
using ::testing::HasSubstr;

std::string refusal(const std::filesystem::path& file, const Overrides& overrides = {}) {
  try {
    read_device_settings(file, overrides);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::BadData);
    return error.what();
  }
  return "";
}

TEST(DeviceSettings, AreDefaultsWithoutAFile) {
  const DeviceSettings settings = read_device_settings("/nowhere/devices.json", {});
  EXPECT_EQ(settings.falcon.exchange.counts_per_Nm, 4000.0);
  EXPECT_TRUE(settings.placements.empty());
}

TEST(DeviceSettings, OfAFileGiveWayToTheCommandLine) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "devices.json";
  write_file(file, R"({"schema": 1,  // of the lab
    "falcon": {"firmware": "/lab/image.bin", "counts_per_Nm": 9000},
    "spacemouse": {"mode": "position", "axis_signs": [1, -1, 1]},
    "placement": {"falcon": {"turn_deg": [0, 90, 0], "scale": 2, "bubble_m": 0.03}}})");
  const DeviceSettings settings = read_device_settings(file, {{"falcon.counts_per_Nm", "5000"}});
  EXPECT_EQ(settings.falcon.firmware, "/lab/image.bin");
  EXPECT_EQ(settings.falcon.exchange.counts_per_Nm, 5000.0);
  EXPECT_EQ(settings.spacemouse.mode, spacemouse::MotionMode::Position);
  EXPECT_EQ(settings.spacemouse.axis_signs, Vec3(1, -1, 1));
  EXPECT_EQ(settings.placements.at("falcon").turn_deg.y(), 90.0);
  EXPECT_EQ(settings.placements.at("falcon").scale, 2.0);
  EXPECT_EQ(settings.placements.at("falcon").bubble_radius_m, 0.03);
}

TEST(DeviceSettings, OutOfRangeAreRefusedWithPlaceAndRange) {
  const std::string nowhere = "/nowhere/devices.json";
  EXPECT_THAT(refusal(nowhere, {{"falcon.counts_per_Nm", "1e6"}}), HasSubstr("/falcon/counts_per_Nm"));
  EXPECT_THAT(refusal(nowhere, {{"falcon.peak_force_N", "0"}}), HasSubstr("between 0.1 and 10"));
  EXPECT_THAT(refusal(nowhere, {{"placement.touch", "{\"scale\": 100}"}}), HasSubstr("/placement/touch/scale"));
  EXPECT_THAT(refusal(nowhere, {{"placement.tuch", "{\"scale\": 1}"}}), HasSubstr("nearest: touch"));
  EXPECT_THAT(refusal(nowhere, {{"placement.touch", "{\"turn_deg\": [0, 1e300, 0]}"}}), HasSubstr("-360 and 360"));
  EXPECT_THAT(refusal(nowhere, {{"inverse3.workspace_middle_m", "[0, 7, 0]"}}), HasSubstr("-0.5 and 0.5"));
  EXPECT_THAT(refusal(nowhere, {{"spacemouse.axis_signs", "[1, 2, 1]"}}), HasSubstr("1 and -1"));
  EXPECT_THAT(refusal(nowhere, {{"inverse3.force_key", "vektor"}}), HasSubstr("vector"));
  EXPECT_THAT(refusal(nowhere, {{"falkon.firmware", "x"}}), HasSubstr("falcon"));
}

TEST(DeviceSettings, BrokenFilesAreRefused) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "devices.json";
  for (const char* text : {"", "[1]", "{", "{\"schema\": 2}", "{\"schema\": 1, \"falcon\": 3}", "\xff\xfe"}) {
    write_file(file, text);
    EXPECT_THAT(refusal(file), HasSubstr("devices.json")) << text;
  }
}

TEST(DeviceSettings, AreKeptBesideWhatElseIsInTheFile) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "made" / "devices.json";
  keep_device_settings(file, {{"falcon.counts_per_Nm", "9000"}});
  keep_device_settings(file, {{"falcon.firmware", "/lab/image.bin"}});
  const DeviceSettings settings = read_device_settings(file, {});
  EXPECT_EQ(settings.falcon.exchange.counts_per_Nm, 9000.0);
  EXPECT_EQ(settings.falcon.firmware, "/lab/image.bin");
  EXPECT_THROW(keep_device_settings(file, {{"falcon.counts_per_Nm", "1"}}), Error);
  EXPECT_EQ(read_device_settings(file, {}).falcon.exchange.counts_per_Nm, 9000.0) << "nothing half-written";
}

TEST(DeviceSettings, AreToldFromThoseOfScenes) {
  EXPECT_TRUE(is_device_setting("falcon.firmware"));
  EXPECT_FALSE(is_device_setting("tissue.default"));
  EXPECT_FALSE(is_device_setting("falcon"));
}

TEST(DriverTable, EveryFamilySaysWhatItSeesAndThrowsNothing) {
  const auto drivers = make_drivers({});
  ASSERT_EQ(drivers.size(), driver_names().size());
  for (std::size_t d = 0; d < drivers.size(); ++d) {
    EXPECT_EQ(drivers[d]->name(), driver_names()[d]);
    EXPECT_GT(nominal_rate_Hz(drivers[d]->name()), 0.0);
    EXPECT_TRUE(is_on_the_table(drivers[d]->name() + ":2"));
    const auto findings = drivers[d]->find();
    ASSERT_FALSE(findings.empty());
    for (const DeviceFinding& finding : findings) {
      EXPECT_EQ(finding.ready, finding.cause.empty()) << finding.name;
      EXPECT_EQ(finding.ready, finding.remedy.empty()) << finding.name;
    }
  }
  EXPECT_FALSE(is_on_the_table("simulated:falcon"));
}

}  // namespace
}  // namespace myotact::device
