// The fibres of a specimen, fitted once and kept beside it.

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/program.h"
#include "core/file.h"
#include "support/source_folder.h"

namespace myotact::testing {
namespace {

using ::testing::HasSubstr;

TEST(Calibrate, WritesTheFileThatTheShippedSpecimenHas) {
  const TemporaryFolder folder;
  const auto specimen = folder.path() / "elbow";
  std::filesystem::copy(source_folder() + "/meshes/canine_elbow", specimen, std::filesystem::copy_options::recursive);
  const auto shipped = nlohmann::json::parse(read_file(specimen / "calibration.json"));
  std::filesystem::remove(specimen / "calibration.json");
  const Outcome outcome = run_program("calibrate " + specimen.string());
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("biceps_brachii"));
  const auto written = nlohmann::json::parse(read_file(specimen / "calibration.json"));
  ASSERT_EQ(written["muscles"].size(), shipped["muscles"].size());
  for (const auto& [key, fit] : shipped["muscles"].items()) {
    const auto& found = written["muscles"][key];
    EXPECT_EQ(found["of"], fit["of"]) << key;
    for (const char* figure : {"offset", "scale", "gain", "beyond", "force"})  // the last digits are a processor's
      EXPECT_NEAR(found[figure].get<double>(), fit[figure].get<double>(), 0.01 * std::abs(fit[figure].get<double>()))
          << key << " " << figure;
  }
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

TEST(Calibrate, ABrokenFitIsNamedWithWhatToDo) {
  const TemporaryFolder folder;
  const auto specimen = folder.path() / "elbow";
  std::filesystem::copy(source_folder() + "/meshes/canine_elbow", specimen, std::filesystem::copy_options::recursive);
  std::ofstream(specimen / "calibration.json") << R"({"schema": 1, "muscles": {"brachialis": {"of": "12"}}})";
  const Outcome outcome = run_program("calibrate " + specimen.string());
  EXPECT_EQ(outcome.status, 65);
  EXPECT_THAT(outcome.output, HasSubstr("/muscles/brachialis/of: must be 16 hexadecimal digits; delete the file"));
}

}  // namespace
}  // namespace myotact::testing
