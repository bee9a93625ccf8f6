// Whole limbs from four sides at both ends of every joint's range, all muscles following their bones, as they were
// looked at and kept in tests/app/pictures/. After a change that is meant: MYOTACT_RENEW_PICTURES=1 writes them anew;
// look at them before you keep them. NAME_full.png beside each is the same limb from the data set's own surfaces:
// `myotact-prepare import`, then `--set specimen=FOLDER/canine_NAME` in the command below, made as small.

#include <cstdlib>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/program.h"
#include "support/source_folder.h"

namespace myotact::testing {
namespace {

/// Of the scale from 0 to 1, mean over the worst block of the sheet. Renderers differ along edges and in shades by some
/// hundredths there; a muscle that comes off, or hides another, makes tenths.
constexpr double kTolerance = 0.06;
/// A limb cut from a volume of a millimetre against the one from full surfaces: 0.09 at subscapularis from medial, and
/// behind the thigh.
constexpr double kLikeFull = 0.12;
constexpr int kBlock_px = 8;
/// Of the sheet's pictures, as kept [px].
constexpr int kWidth_px = 72, kHeight_px = 96;

const std::filesystem::path kKept = std::filesystem::path(source_folder()) / "tests/app/pictures";

std::string output_of(const std::string& command) {
  std::string output;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return output;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output.push_back(static_cast<char>(c));
  pclose(pipe);
  return output;
}

/// The mean difference of the block where two pictures differ most.
double largest_difference(const std::string& a, const std::string& b, int width_px, int height_px) {
  return std::stod(output_of(
      fmt::format("convert {} {} -alpha off -compose difference -composite -colorspace Gray -scale '{}x{}!' -format "
                  "'%[fx:maxima]' info:",
                  a, b, width_px / kBlock_px, height_px / kBlock_px)));
}

struct Limb {
  std::string scene;
  int rows;             // of its sheet: its own pose, and two a joint
  int carpus_row = -1;  // where the two of the carpus begin, if it has one
};

std::ostream& operator<<(std::ostream& out, const Limb& limb) {
  return out << limb.scene;
}

class LimbPictures : public ::testing::TestWithParam<Limb> {};

TEST_P(LimbPictures, LookAsKept) {
  const auto& [scene, rows, carpus_row] = GetParam();
  TemporaryFolder folder;
  const std::string sheet = (folder.path() / "sheet.png").string();
  const Outcome outcome = run_program(fmt::format(
      "run {} --set tissue.default=rigid --seconds 0.01 --sheet {} --out {}", scene, sheet, folder.path().string()));
  if (outcome.status == 69) GTEST_SKIP() << outcome.output;
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  const std::string now = (folder.path() / "now.png").string();
  const std::string kept = (kKept / (scene + ".png")).string();
  ASSERT_EQ(
      output_of(fmt::format("convert {} -resize '{}x{}!' -strip -define png:exclude-chunks=date,time {} && echo done",
                            sheet, 4 * kWidth_px, rows * kHeight_px, now)),
      "done\n");
  if (std::getenv("MYOTACT_RENEW_PICTURES") != nullptr) {
    std::filesystem::create_directories(kKept);
    std::filesystem::copy_file(now, kept, std::filesystem::copy_options::overwrite_existing);
  }
  const double difference = largest_difference(now, kept, 4 * kWidth_px, rows * kHeight_px);
  fmt::print("{}: largest difference {:.4f}\n", scene, difference);
  EXPECT_LT(difference, kTolerance);
  const std::string full = (kKept / (scene + "_full.png")).string();
  const double from_full = largest_difference(now, full, 4 * kWidth_px, rows * kHeight_px);
  fmt::print("{}: largest difference from the full surfaces {:.4f}\n", scene, from_full);
  EXPECT_LT(from_full, kLikeFull);
  // Of every joint's two ends none looks like the other. The carpus moves no more than a paw: its ends differ by 0.15.
  for (int row = 1; row < rows; row += 2) {
    const auto cut = [&](int r) {
      return fmt::format("\\( {} -crop {}x{}+0+{} +repage \\)", kept, 4 * kWidth_px, kHeight_px, r * kHeight_px);
    };
    const double least = row == carpus_row ? 2.0 * kTolerance : 3.0 * kTolerance;
    EXPECT_GT(largest_difference(cut(row), cut(row + 1), 4 * kWidth_px, kHeight_px), least) << row;
  }
}

INSTANTIATE_TEST_SUITE_P(Limbs, LimbPictures, ::testing::Values(Limb{"forelimb", 7, 5}, Limb{"hindlimb", 7}),
                         [](const auto& limb) { return limb.param.scene; });

}  // namespace
}  // namespace myotact::testing
