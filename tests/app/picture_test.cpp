// Pictures from the command line: asked for in words, refused before anything is simulated.

#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/program.h"

namespace myotact::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Width and height from the header of a PNG (W3C PNG, 11.2.2).
std::pair<unsigned, unsigned> size_of_png(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes(24, '\0');
  file.read(bytes.data(), 24);
  if (bytes.compare(1, 3, "PNG") != 0) return {0, 0};
  const auto number = [&](std::size_t at) {
    unsigned value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = 256 * value + static_cast<unsigned char>(bytes[at + i]);
    return value;
  };
  return {number(16), number(20)};
}

TEST(Picture, IsWrittenAtItsSizeOrTheProgramSaysWhyNot) {
  TemporaryFolder folder;
  const auto png = folder.path() / "p.png";
  const Outcome outcome = run_program(
      "run bimanual --seconds 0.02 --view 60,10 --size 320x240 --show labels=on "
      "muscles=biceps_brachii names=latin --png " +
      png.string() + " --out " + folder.path().string());
  if (outcome.status == 69) GTEST_SKIP() << outcome.output;
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_EQ(size_of_png(png), (std::pair{320u, 240u}));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "scene.png"));
}

TEST(Picture, ASheetHasFourSidesOfEachEndOfEachJointsRange) {
  TemporaryFolder folder;
  const auto png = folder.path() / "sheet.png";
  const Outcome outcome = run_program("run bimanual --set tissue.default=rigid --seconds 0.02 --sheet " + png.string() +
                                      " --out " + folder.path().string());
  if (outcome.status == 69) GTEST_SKIP() << outcome.output;
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  const auto [width, height] = size_of_png(png);
  EXPECT_EQ(width, 4u * 240u);
  EXPECT_EQ(height % (2u * 320u), 320u) << "the scene's own pose, and two a joint";
  EXPECT_GT(height, 320u);
}

TEST(Picture, AWrongWordEndsWithUsageAndTheNearestKnownOne) {
  TemporaryFolder folder;
  const std::string run = "run elbow --seconds 3600 --out " + folder.path().string() + " ";
  const auto expect_usage = [&](const std::string& options, const auto& says) {
    const Outcome outcome = run_program(run + options);
    EXPECT_EQ(outcome.status, 2) << options;
    EXPECT_THAT(outcome.output, says);
  };
  expect_usage("--show muscles=bicep", AllOf(HasSubstr("bicep"), HasSubstr("biceps_brachii")));
  expect_usage("--show colour=tensoin", HasSubstr("\"tension\""));
  expect_usage("--view laterall", HasSubstr("nearest: lateral"));
  expect_usage("--size 12", HasSubstr("1280x720"));
}

}  // namespace
}  // namespace myotact::testing
