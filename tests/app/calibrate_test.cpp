// The fibres of a specimen, fitted once and kept beside it.

#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/program.h"
#include "core/file.h"
#include "support/source_folder.h"

namespace myotact::testing {
namespace {

using ::testing::HasSubstr;

TEST(Calibrate, WritesTheFileThatTheShippedSpecimenHas) {
  const TemporaryFolder folder;
  const auto specimen = folder.path() / "pad";
  std::filesystem::copy(source_folder() + "/meshes/canine_elbow", specimen, std::filesystem::copy_options::recursive);
  const std::string shipped = read_file(specimen / "calibration.json");
  std::filesystem::remove(specimen / "calibration.json");
  const Outcome outcome = run_program("calibrate " + specimen.string());
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("biceps_brachii"));
  EXPECT_EQ(read_file(specimen / "calibration.json").size() / 100, shipped.size() / 100);  // the last digits may differ
}

TEST(Calibrate, WhatIsNoSpecimenIsNamedAndNothingIsLeft) {
  const TemporaryFolder folder;
  const Outcome nothing = run_program("calibrate " + (folder.path() / "nowhere").string());
  EXPECT_EQ(nothing.status, 66);
  EXPECT_THAT(nothing.output, HasSubstr("specimen.json is missing"));
  std::ofstream(folder.path() / "specimen.json") << "{";
  const Outcome broken = run_program("calibrate " + folder.path().string());
  EXPECT_EQ(broken.status, 65);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "calibration.json"));
}

}  // namespace
}  // namespace myotact::testing
