#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gui/gui_program.h"
#include "support/source_folder.h"

// Keys and mouse as a person likes them, the window without a mouse, and big type for a class.

namespace myotact {
namespace {

using nlohmann::json;
using testing::GuiProgram;

/// The control that has the keyboard; "" for none.
std::string focused_control(const json& state) {
  for (const json& control : state["controls"]) {
    if (control["focused"]) return control["key"];
  }
  return "";
}

class ComfortTest : public testing::GuiTest {};

TEST_F(ComfortTest, AKeyIsGivenAwayAndTheMouseWorksAsInBlender) {
  GuiProgram gui("comfort", "elbow --set tissue.default=line");
  const auto becomes = [&](const std::string& control, const std::string& value) {
    return gui.wait_until([&](const json&) { return gui.value_of(control) == value; });
  };
  gui.key("ctrl+6");
  gui.click("comfort.keys");
  gui.click("keys.look");
  ASSERT_TRUE(becomes("keys.look", "Press a key"));
  gui.key("h");  // hides what is selected
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.shows("comfort.key_refused"); }));
  EXPECT_NE(gui.value_of("comfort.key_refused").find("hide what is selected"), std::string::npos);
  gui.screenshot("refused");
  gui.click("keys.touch");
  ASSERT_TRUE(becomes("keys.touch", "Press a key"));
  gui.key("ctrl+k");
  EXPECT_TRUE(becomes("keys.touch", "Ctrl+K"));
  gui.key("ctrl+k");
  EXPECT_TRUE(becomes("toolbar.touch", "on"));
  gui.key("v");
  EXPECT_TRUE(becomes("toolbar.look", "on"));
  gui.key("t");  // nothing any more
  gui.let_draw();
  EXPECT_EQ(gui.value_of("toolbar.touch"), "off");

  gui.click("comfort.mouse");
  gui.click("mouse.blender");
  EXPECT_TRUE(becomes("comfort.mouse", "mouse.blender"));
  const json before = gui.state()["view"]["camera"];
  gui.key("KP_1");
  EXPECT_TRUE(gui.wait_until(
      [&](const json& state) { return state["view"]["camera"]["azimuth_rad"] != before["azimuth_rad"]; }));
  gui.key("F1");
  EXPECT_TRUE(gui.wait_until([&](const json&) { return gui.shows("mouse.shift_middle"); }));
  EXPECT_FALSE(gui.shows("mouse.right"));
  gui.screenshot("help");
}

TEST_F(ComfortTest, TheKeyboardReachesEveryArea) {
  GuiProgram gui("keyboard", "elbow --set tissue.default=line");
  gui.key("ctrl+2");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.shows("see.labels"); }));
  std::set<std::string> areas;
  for (int i = 0; i < 8; ++i) {
    gui.key("F6");
    const std::string at = focused_control(gui.state());
    areas.insert(at.substr(0, at.find('.')));
  }
  EXPECT_EQ(areas, (std::set<std::string>{"toolbar", "find", "tasks", "see", "keep"}));
}

TEST_F(ComfortTest, TheKeyboardReachesEveryControlOfAPanel) {
  GuiProgram gui("keyboard_panel", "elbow --set tissue.default=line");
  gui.key("ctrl+2");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.shows("see.labels"); }));
  for (int i = 0; i < 8 && focused_control(gui.state()).rfind("see.", 0) != 0; ++i) gui.key("F6");
  std::set<std::string> missing;
  const json state = gui.state();
  for (const json& control : state["controls"]) {
    const std::string key = control["key"];
    if (key.rfind("see.", 0) == 0) missing.insert(key);
  }
  ASSERT_GT(missing.size(), 8u);
  // A key that is held repeats, and a short one may fall between two pictures: so down and up, several times.
  const std::size_t count = missing.size();
  for (std::size_t i = 0; i < 12 * count && !missing.empty(); ++i) {
    missing.erase(focused_control(gui.state()));
    gui.tap(i / (2 * count) % 2 == 0 ? "Down" : "Up");
  }
  EXPECT_TRUE(missing.empty()) << (missing.empty() ? "" : *missing.begin());
}

/// From the window's opening to a muscle that is felt, by what the window says alone.
TEST_F(ComfortTest, ANewcomerIsLedFromTheLimbToCoContraction) {
  const auto fresh = std::filesystem::path(::testing::TempDir()) / "newcomer";
  std::filesystem::remove_all(fresh);
  GuiProgram gui("newcomer", "elbow", "XDG_CONFIG_HOME=" + fresh.string());
  const auto opened = std::chrono::steady_clock::now();
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.shows("first.press"); }));
  gui.screenshot("first");
  const auto place = [&] {
    const auto box = gui.box_of("first.place");
    return std::array{box[0] + 0.5 * box[2], box[1] + 0.5 * box[3]};
  };
  const auto press = [&] {
    const auto [x, y] = place();
    gui.move_to(x, y);
    gui.press(1);
  };
  press();
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.shows("first.contract"); }));
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - opened;
  std::printf("touched %.1f s after the window had opened\n", taken.count());
  EXPECT_LT(taken.count(), 20.0);
  gui.release(1);
  gui.screenshot("contract");
  gui.click("tasks.demonstrate");
  gui.click("demonstrate.preset.firm");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.shows("first.press_again"); }));
  press();
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.shows("first.learn"); }));
  gui.release(1);
  gui.screenshot("learn");
  gui.click("first.done");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return !gui.shows("first.learn"); }));
  EXPECT_TRUE(std::filesystem::exists(fresh / "myotact" / "settings.json")) << "and is not led again";
  gui.key("F1");
  gui.click("help.tour");
  EXPECT_TRUE(gui.wait_until([&](const json&) { return gui.shows("tour.next"); }));
  gui.click("tour.skip");
}

TEST_F(ComfortTest, WhoNamesNoSceneIsAskedWhatFor) {
  GuiProgram gui("start", "--set tissue.default=line");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.shows("start.touch"); }));
  gui.screenshot("start");
  gui.click("comfort.language.de");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.value_of("start.touch") == "Eine Gliedmaße tasten"; }));
  gui.click("comfort.language.en");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.value_of("start.touch") == "Touch a limb"; }));
  gui.click("start.prepare");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.shows("start.back") && !gui.shows("start.touch"); }));
  gui.screenshot("prepare");
  gui.click("start.back");
  gui.click("start.teach");
  EXPECT_TRUE(gui.wait_until([&](const json&) { return gui.value_of("tasks.demonstrate") == "on"; }));
  EXPECT_FALSE(gui.shows("start.touch"));
  gui.click("toolbar.start");
  gui.click("start.lesson");
  EXPECT_TRUE(gui.wait_until([&](const json&) { return gui.value_of("tasks.learn") == "on"; }));
  gui.click("toolbar.start");
  gui.click("start.touch");  // somebody who asks for it is led, though he was before
  EXPECT_TRUE(gui.wait_until([&](const json&) { return gui.shows("first.press"); }));
  gui.click("toolbar.start");
  gui.click("start.close");
  EXPECT_TRUE(gui.wait_until([&](const json&) { return !gui.shows("start.close"); }));
}

TEST_F(ComfortTest, PanelsFoldAwayAndTwoStatesAreFeltInTurn) {
  GuiProgram gui("fold", "elbow --set tissue.default=line");
  gui.click("fold.tasks");
  EXPECT_TRUE(gui.wait_until([&](const json&) { return !gui.shows("tasks.see") && gui.shows("find.search"); }));
  gui.key("F2");
  EXPECT_TRUE(gui.wait_until([&](const json&) { return !gui.shows("find.search"); }));
  gui.screenshot("folded");
  gui.click("fold.find");
  gui.key("F3");
  EXPECT_TRUE(gui.wait_until([&](const json&) { return gui.shows("tasks.see") && gui.shows("find.search"); }));
  gui.click("tasks.demonstrate");
  gui.click("demonstrate.store_a");
  gui.click("demonstrate.preset.firm");
  ASSERT_TRUE(gui.wait_until([](const json& s) { return s["scene"]["common"] == 1.0; }));
  gui.click("demonstrate.store_b");
  gui.key("F4");
  EXPECT_TRUE(gui.wait_until([](const json& s) { return s["scene"]["common"] == 0.0; }));
  gui.key("F4");
  EXPECT_TRUE(gui.wait_until([](const json& s) { return s["scene"]["common"] == 1.0; }));
  EXPECT_NE(gui.value_of("demonstrate.K").find("N m/rad"), std::string::npos);
}

TEST_F(ComfortTest, BigTypeShowsTheStiffnessToAClassAndGoesAway) {
  GuiProgram gui("class", "elbow --set tissue.default=line");
  gui.key("F9");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.shows("class.K") && !gui.shows("tasks.see"); }));
  gui.key("equal");
  gui.key("equal");
  EXPECT_TRUE(gui.wait_until([](const json& state) {
    return state["scene"]["drive"] == "balance" && std::abs(state["scene"]["common"].get<double>() - 0.1) < 1e-12;
  }));
  gui.key("minus");
  EXPECT_TRUE(gui.wait_until(
      [](const json& state) { return std::abs(state["scene"]["common"].get<double>() - 0.05) < 1e-12; }));
  gui.screenshot("big");
  gui.key("F9");
  EXPECT_TRUE(gui.wait_until([&](const json&) { return !gui.shows("class.K") && gui.shows("tasks.see"); }));
}

/// Where the script or the scene's own beginning drives the muscles, "+" goes on from there.
TEST_F(ComfortTest, MoreCoContractionGoesOnFromTheLevelInForce) {
  const std::string file = ::testing::TempDir() + "driven_elbow.json";
  json scene = json::parse(std::ifstream(source_folder() + "/assets/scenes/elbow.json"), nullptr, true, true);
  scene["co_contraction"]["common"] = 0.4;
  std::ofstream(file) << scene.dump();
  GuiProgram gui("class_driven", file + " --set tissue.default=line");
  gui.key("F9");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.shows("class.more"); }));
  EXPECT_EQ(gui.state()["scene"]["drive"], "script");
  gui.click("class.more");
  ASSERT_TRUE(gui.wait_until([](const json& state) { return state["scene"]["drive"] == "balance"; }));
  EXPECT_NEAR(gui.state()["scene"]["common"].get<double>(), 0.45, 1e-12);
  EXPECT_TRUE(
      gui.wait_until([&](const json&) { return gui.value_of("class.common").find("45") != std::string::npos; }));
}

}  // namespace
}  // namespace myotact
