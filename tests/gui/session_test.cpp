#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gui/gui_program.h"

// What a person saves and opens again: a work, a bookmark, a note.

namespace myotact {
namespace {

using nlohmann::json;
using testing::GuiProgram;

class SessionTest : public testing::GuiTest {};

/// Whether the camera's way has an end: the view is that of `wanted`, to a thousandth.
bool looks_as(const json& view, const json& wanted) {
  for (const char* key : {"hidden_muscles", "faded_muscles", "hidden_bones", "faded_bones", "selected_muscle"}) {
    if (view[key] != wanted[key]) return false;
  }
  for (const auto& [key, value] : wanted["camera"].items()) {
    if (std::abs(view["camera"][key].get<double>() - value.get<double>()) > 1e-3) return false;
  }
  return true;
}

std::string saved_file(const GuiProgram& gui) {
  const std::filesystem::path works = gui.folder() / "home/data/myotact/works";
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(works, none)) {
    if (entry.path().extension() == ".json") return entry.path().string();
  }
  return "";
}

TEST_F(SessionTest, ASavedWorkABookmarkAndANoteComeBack) {
  GuiProgram gui("session", "elbow --set tissue.default=line");
  gui.click("find.biceps_brachii", 3);
  gui.click("session.note");
  testing::pause_s(1.0);  // until the note has the keyboard, in a slow picture too
  gui.type("two joints");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.value_of("find.noted.biceps_brachii") == "two joints"; }));
  gui.click("find.shown.brachialis");
  gui.click("toolbar.cranial");
  gui.click("tasks.demonstrate");
  gui.click("demonstrate.preset.firm");
  ASSERT_TRUE(gui.wait_until([](const json& s) { return s["scene"]["common"] == 1.0; }));
  testing::pause_s(1.0);  // until the camera is there
  gui.let_draw();
  const json view = gui.state()["view"], scene = gui.state()["scene"];
  EXPECT_EQ(view["hidden_muscles"], json({"brachialis"}));
  gui.click("tasks.see");
  gui.click("session.bookmark_name");
  testing::pause_s(1.0);
  gui.type("front");
  gui.click("session.bookmark_add");
  EXPECT_TRUE(gui.wait_until([&](const json&) { return gui.value_of("session.bookmark.0") == "front"; }));
  gui.click("session.save_now");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return !saved_file(gui).empty(); }));

  const auto change = [&] {
    gui.click("toolbar.lateral");
    gui.click("find.shown.humerus");
    gui.click("find.shown.brachialis");
    ASSERT_TRUE(gui.wait_until([&](const json& s) {
      return s["view"]["hidden_bones"] == json({"humerus"}) && s["view"]["hidden_muscles"].empty();
    }));
    testing::pause_s(1.0);
    gui.let_draw();
  };
  change();
  const json changed = gui.state()["view"];
  gui.click("session.bookmark.0");
  EXPECT_TRUE(gui.wait_until([&](const json& s) { return looks_as(s["view"], view); }));
  gui.click("toolbar.undo");
  EXPECT_TRUE(gui.wait_until([&](const json& s) { return looks_as(s["view"], changed); }));
  gui.click("tasks.demonstrate");
  gui.click("demonstrate.preset.rest");
  ASSERT_TRUE(gui.wait_until([](const json& s) { return s["scene"]["common"] == 0.0; }));
  gui.key("ctrl+o");
  gui.click("session.work.0");
  EXPECT_TRUE(gui.wait_until([&](const json& s) { return looks_as(s["view"], view) && s["scene"] == scene; }));
  gui.screenshot("opened");
  gui.click("toolbar.undo");
  EXPECT_TRUE(
      gui.wait_until([&](const json& s) { return looks_as(s["view"], changed) && s["scene"]["common"] == 0.0; }));

  std::ofstream(saved_file(gui), std::ios::trunc) << R"({"schema": 1, "scene": "elb)";
  gui.key("ctrl+o");
  gui.click("session.work.0");
  EXPECT_TRUE(gui.wait_until(
      [&](const json&) { return gui.value_of("news.message").find(saved_file(gui)) != std::string::npos; }));
  EXPECT_TRUE(looks_as(gui.state()["view"], changed));

  gui.key("ctrl+6");
  gui.click("comfort.language");
  gui.click("comfort.language.de");
  gui.key("ctrl+o");
  gui.click("session.work.0");
  EXPECT_TRUE(gui.wait_until(
      [&](const json&) { return gui.value_of("news.message").find("zuletzt gelesen") != std::string::npos; }));
  gui.screenshot("german");
}

TEST_F(SessionTest, TheTwoStatesThatAreFeltInTurnComeBackWithTheWork) {
  const auto common_is = [](double wanted) {
    return [wanted](const json& s) { return s["scene"]["common"] == wanted; };
  };
  const std::filesystem::path kept = std::filesystem::path(MYOTACT_GUI_PICTURES) / "kept_work.json";
  {
    GuiProgram gui("kept", "elbow --set tissue.default=line");
    gui.click("tasks.demonstrate");
    gui.click("demonstrate.store_a");
    gui.click("demonstrate.preset.firm");
    ASSERT_TRUE(gui.wait_until(common_is(1.0)));
    gui.click("demonstrate.store_b");
    gui.click("tasks.see");
    gui.click("session.save_now");
    ASSERT_TRUE(gui.wait_until([&](const json&) { return !saved_file(gui).empty(); }));
    std::filesystem::copy_file(saved_file(gui), kept, std::filesystem::copy_options::overwrite_existing);
  }
  GuiProgram gui("kept_again", "--session " + kept.string());
  ASSERT_TRUE(gui.wait_until(common_is(1.0)));
  gui.key("F4");
  EXPECT_TRUE(gui.wait_until(common_is(0.0)));
  gui.key("F4");
  EXPECT_TRUE(gui.wait_until(common_is(1.0)));
}

TEST_F(SessionTest, AWorkOfAnotherSceneOpensThatSceneWithItsMarks) {
  const std::string file = (std::filesystem::path(MYOTACT_GUI_PICTURES) / "stifle_work.json").string();
  std::filesystem::create_directories(MYOTACT_GUI_PICTURES);
  std::ofstream(file) << R"({"schema": 1, "scene": "stifle", "tissue": "line",
    "view": {"camera": {"target_m": [0, 0, 0.2], "azimuth_rad": 1.0, "elevation_rad": 0.25, "distance_m": 1.5},
             "hidden": ["patella", "os_penis"]},
    "settings": {"drive": "balance", "common": 0.25}, "notes": {"rectus_femoris": "begins on the pelvis"}})";
  GuiProgram gui("session_scene", "--session " + file);
  EXPECT_TRUE(
      gui.wait_until([](const json& s) { return s["scene_name"] == "stifle" && s["scene"]["common"] == 0.25; }));
  EXPECT_TRUE(gui.wait_until([](const json& s) { return s["view"]["camera"]["azimuth_rad"] == 1.0; }));
  EXPECT_EQ(gui.state()["view"]["hidden_bones"], json({"patella"}));
  EXPECT_TRUE(
      gui.wait_until([&](const json&) { return gui.value_of("news.message").find("os_penis") != std::string::npos; }));
  EXPECT_TRUE(
      gui.wait_until([&](const json&) { return gui.value_of("find.noted.rectus_femoris") == "begins on the pelvis"; }));
}

}  // namespace
}  // namespace myotact
