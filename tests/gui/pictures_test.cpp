#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gui/gui_program.h"
#include "support/source_folder.h"

// What the scene looks like, compared with small pictures that are kept in tests/gui/pictures/. After a change that is
// meant: MYOTACT_RENEW_PICTURES=1 writes them anew; look at them before you keep them.

namespace myotact {
namespace {

using nlohmann::json;
using testing::GuiProgram;

/// Of the scale from 0 to 1, mean over the picture. Renderers differ along edges and in shades, some thousandths; a
/// limb that is not there, or another one, makes some hundredths.
constexpr double kTolerance = 0.008;

const std::filesystem::path kKept = std::filesystem::path(source_folder()) / "tests/gui/pictures";

void convert(const std::string& arguments) {
  ASSERT_EQ(std::system(("convert " + arguments).c_str()), 0) << arguments;
}

class PicturesTest : public testing::GuiTest {};

/// The scene's part of the display below its notices, which come and go, brought to 160 x 100.
std::filesystem::path small_picture(const GuiProgram& gui, const std::string& name) {
  constexpr double kNotices_px = 110.0;
  const std::filesystem::path whole = gui.screenshot(name), small = gui.folder() / (name + "_small.png");
  const std::array<double, 4> box = gui.state()["scene_box"];
  const std::string crop =
      fmt::format("{:.0f}x{:.0f}+{:.0f}+{:.0f}", box[2], box[3] - kNotices_px, box[0], box[1] + kNotices_px);
  convert(whole.string() + " -crop " + crop + " +repage -resize '160x100!' -strip " + small.string());
  return small;
}

void expect_as_kept(const GuiProgram& gui, const std::string& name) {
  const std::filesystem::path now = small_picture(gui, name), kept = kKept / (name + ".png");
  if (std::getenv("MYOTACT_RENEW_PICTURES") != nullptr) {
    std::filesystem::create_directories(kKept);
    std::filesystem::copy_file(now, kept, std::filesystem::copy_options::overwrite_existing);
  }
  const double difference = testing::picture_difference(now, kept);
  std::printf("%s: difference %.4f\n", name.c_str(), difference);
  EXPECT_LT(difference, kTolerance) << "compare " << now << " with " << kept;
}

TEST_F(PicturesTest, TheSceneLooksAsKept) {
  GuiProgram gui("kept_elbow", "elbow --set tissue.default=line");
  ASSERT_TRUE(gui.wait_until([](const json& state) { return state["frame"]["time_s"] > 2.0; }));  // it is at rest
  gui.key("space");
  ASSERT_TRUE(gui.wait_until([](const json& state) { return state["scene"]["paused"] == true; }));
  gui.move_to(1100.0, 700.0);  // nothing in the scene lights up
  expect_as_kept(gui, "elbow");
  gui.key("3");
  const auto turned = [](const json& state) { return state["turning"] == false; };
  ASSERT_TRUE(gui.wait_until(turned));
  expect_as_kept(gui, "elbow_cranial");
  gui.key("1");
  ASSERT_TRUE(gui.wait_until(turned));
  gui.double_click("find.biceps_brachii");
  ASSERT_TRUE(gui.wait_until([](const json& s) { return s["view"]["hidden_muscles"].size() == 6; }));
  gui.move_to(1100.0, 700.0);
  expect_as_kept(gui, "biceps");
}

TEST_F(PicturesTest, ABlankPictureOrThatOfAnotherViewDiffers) {
  const std::filesystem::path blank = std::filesystem::path(MYOTACT_GUI_PICTURES) / "blank.png";
  const std::array<std::string, 3> names = {"elbow", "elbow_cranial", "biceps"};
  for (const std::string& name : names) {
    const std::filesystem::path kept = kKept / (name + ".png");
    // Of the kept picture's mean colour: as near to it as a blank one comes.
    convert(kept.string() + " -resize '1x1!' -resize '160x100!' " + blank.string());
    EXPECT_GT(testing::picture_difference(blank, kept), 2.0 * kTolerance) << name;
    convert("-size 160x100 xc:'#f4f5f7' " + blank.string());  // the scene's ground without a limb
    EXPECT_GT(testing::picture_difference(blank, kept), 2.0 * kTolerance) << name;
    for (const std::string& other : names) {
      if (other == name) continue;
      const double difference = testing::picture_difference(kKept / (other + ".png"), kept);
      std::printf("%s and %s: difference %.4f\n", name.c_str(), other.c_str(), difference);
      EXPECT_GT(difference, kTolerance) << name << " and " << other;
    }
  }
}

}  // namespace
}  // namespace myotact
