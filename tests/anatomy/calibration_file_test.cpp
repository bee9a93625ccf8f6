// What the simulation found out about a specimen's fibres, beside the specimen.

#include "anatomy/calibration_file.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/file.h"
#include "support/synthetic_specimen.h"
#include "support/temporary_folder.h"

namespace myotact::anatomy {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class CalibrationFile : public ::testing::Test {
 protected:
  std::string complaint(const std::string& text) const {
    Specimen specimen = testing::antagonist_hinge();
    std::ofstream(folder_.path() / kCalibrationFile) << text;
    try {
      read_calibration(folder_.path(), specimen);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  testing::TemporaryFolder folder_;
};

TEST_F(CalibrationFile, ComesBackToTheBit) {
  Specimen specimen = testing::antagonist_hinge(), read = specimen;
  specimen.muscles[1].fibre_fit = FibreFit{0xfedcba9876543210u, 0.1, 1.0 / 3.0, 2.5, 0.7, -0.3};
  std::ofstream(folder_.path() / kCalibrationFile) << calibration_json(specimen);
  read_calibration(folder_.path(), read);
  EXPECT_FALSE(read.muscles[0].fibre_fit);
  ASSERT_TRUE(read.muscles[1].fibre_fit);
  const FibreFit &a = *specimen.muscles[1].fibre_fit, &b = *read.muscles[1].fibre_fit;
  EXPECT_EQ(a.of, b.of);
  EXPECT_EQ(a.offset, b.offset);
  EXPECT_EQ(a.scale, b.scale);
  EXPECT_EQ(a.gain, b.gain);
  EXPECT_EQ(a.beyond, b.beyond);
  EXPECT_EQ(a.force, b.force);
  EXPECT_FALSE(read.muscles[1].fibre_fit_on_bones);
}

TEST_F(CalibrationFile, KeepsTheFitOnBonesApart) {
  Specimen specimen = testing::antagonist_hinge(), read = specimen;
  specimen.muscles[0].fibre_fit_on_bones = FibreFit{1, 0.1, 1.0, 2.0, 0.5, 0.9};
  std::ofstream(folder_.path() / kCalibrationFile) << calibration_json(specimen);
  read_calibration(folder_.path(), read);
  EXPECT_FALSE(read.muscles[0].fibre_fit);
  ASSERT_TRUE(read.muscles[0].fibre_fit_on_bones);
  EXPECT_EQ(read.muscles[0].fibre_fit_on_bones->gain, 2.0);
}

TEST_F(CalibrationFile, MayBeMissingOrSpeakOfOthers) {
  Specimen specimen = testing::antagonist_hinge();
  read_calibration(folder_.path(), specimen);
  EXPECT_FALSE(specimen.muscles[0].fibre_fit);
  EXPECT_EQ(complaint(R"({"schema": 1, "muscles": {}})"), "");
}

TEST_F(CalibrationFile, ABrokenOneIsNamedWithItsPlace) {
  EXPECT_THAT(complaint("{\"schema\": 1, \"mus"), HasSubstr(kCalibrationFile));
  EXPECT_THAT(complaint(R"({"schema": 2, "muscles": {}})"), HasSubstr("/schema"));
  const std::string fit = R"({"schema": 1, "muscles": {"flexor": {"of": "OF", "offset": 0, "scale": SCALE, "gain": 1,)"
                          R"( "beyond": 1, "force": 1}}})";
  const auto with = [&](const std::string& of, const std::string& scale) {
    std::string text = fit;
    text.replace(text.find("OF"), 2, of);
    text.replace(text.find("SCALE"), 5, scale);
    return complaint(text);
  };
  EXPECT_EQ(with("00000000000000ff", "1"), "");
  EXPECT_THAT(with("ff", "1"), AllOf(HasSubstr("/muscles/flexor/of"), HasSubstr("16 hexadecimal digits")));
  EXPECT_THAT(with("00000000000000fg", "1"), HasSubstr("16 hexadecimal digits"));
  EXPECT_THAT(with("00000000000000ff", "-1"), HasSubstr("/muscles/flexor/scale"));
  EXPECT_THAT(with("00000000000000ff", "1e9"), HasSubstr("/muscles/flexor/scale"));
}

}  // namespace
}  // namespace myotact::anatomy
