#include <cmath>
#include <csignal>
#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gui/gui_program.h"

// What a person does at the window, and what comes of it.

namespace myotact {
namespace {

using nlohmann::json;
using testing::GuiProgram;

class WindowTest : public testing::GuiTest {};

/// The scene's part of a picture holds many colours: no blank frame passes.
void expect_drawn(const GuiProgram& gui, const std::string& name) {
  const std::array<double, 4> box = gui.state()["scene_box"];
  const auto pixels = [](double length) { return static_cast<int>(length); };
  EXPECT_GT(testing::colours_in(gui.screenshot(name), {pixels(box[0]), pixels(box[1]), pixels(box[2]), pixels(box[3])}),
            200)
      << name;
}

TEST_F(WindowTest, SlidersStiffenTheJointAndUndoTakesThemBack) {
  GuiProgram gui("sliders", "elbow");
  expect_drawn(gui, "start");
  const double K_start = gui.state()["frame"]["joints"]["elbow"]["K_Nm_rad"];
  gui.click("tasks.demonstrate");
  gui.drag_slider("demonstrate.common", 0.02, 0.7);
  ASSERT_TRUE(gui.wait_until([](const json& state) { return state["scene"]["common"] > 0.5; }));
  EXPECT_EQ(gui.state()["scene"]["drive"], "balance");
  EXPECT_TRUE(
      gui.wait_until([&](const json& state) { return state["frame"]["joints"]["elbow"]["K_Nm_rad"] > 1.5 * K_start; }));
  const double common = gui.state()["scene"]["common"];
  gui.drag_slider("demonstrate.difference", 0.5, 0.6);
  ASSERT_TRUE(gui.wait_until([](const json& state) { return state["scene"]["difference"] > 0.02; }));
  expect_drawn(gui, "stiffened");
  gui.click("toolbar.undo");
  EXPECT_TRUE(gui.wait_until([](const json& state) { return state["scene"]["difference"] == 0.0; }));
  EXPECT_EQ(gui.state()["scene"]["common"], common);
  gui.click("toolbar.undo");
  EXPECT_TRUE(gui.wait_until([](const json& state) { return state["scene"]["common"] == 0.0; }));
  EXPECT_TRUE(
      gui.wait_until([&](const json& state) { return state["frame"]["joints"]["elbow"]["K_Nm_rad"] < 1.2 * K_start; }));
}

TEST_F(WindowTest, AMuscleIsFoundThroughASlipIsolatedTouchedAndPulled) {
  GuiProgram gui("find", "elbow");
  gui.key("ctrl+f");
  gui.type("bicps");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.value_of("find.search") == "bicps"; }));
  gui.let_draw();
  gui.click("find.biceps_brachii");
  ASSERT_TRUE(gui.wait_until([](const json& s) { return s["view"]["selected_muscle"] == "biceps_brachii"; }));
  gui.double_click("find.biceps_brachii");
  ASSERT_TRUE(gui.wait_until([](const json& s) { return s["view"]["hidden_muscles"].size() == 6; }));
  expect_drawn(gui, "isolated");
  gui.click("toolbar.undo");
  EXPECT_TRUE(gui.wait_until([](const json& s) { return s["view"]["hidden_muscles"].empty(); }));
  EXPECT_EQ(gui.state()["view"]["selected_muscle"], "biceps_brachii");  // selecting it was a step of its own
  gui.click("toolbar.redo");
  EXPECT_TRUE(gui.wait_until([](const json& s) { return s["view"]["hidden_muscles"].size() == 6; }));

  gui.click("toolbar.cranial");
  testing::pause_s(0.6);
  gui.click("toolbar.touch");
  const auto middle = gui.place_of("muscles", "biceps_brachii");
  gui.move_to(middle[0], middle[1]);
  testing::pause_s(1.5);
  gui.press();
  EXPECT_TRUE(
      gui.wait_until([](const json& s) { return s["frame"]["tools"][0]["touched_muscle"] == "biceps_brachii"; }));
  expect_drawn(gui, "touched");
  gui.release();
  EXPECT_TRUE(gui.wait_until([](const json& s) { return !s["frame"]["tools"][0]["in_contact"]; }));
  gui.move_to(middle[0], middle[1]);
  gui.press();
  EXPECT_TRUE(gui.wait_until([](const json& s) { return s["frame"]["tools"][0]["in_contact"] == true; }));
  gui.move_to(1000.0, 600.0);  // a panel: the button is let go where the scene does not see it
  gui.release();
  EXPECT_TRUE(gui.wait_until([](const json& s) { return !s["frame"]["tools"][0]["in_contact"]; }));

  gui.click("toolbar.pull");
  gui.move_to(middle[0], middle[1]);
  testing::pause_s(1.5);
  gui.press();
  EXPECT_TRUE(gui.wait_until([](const json& s) { return s["frame"]["tools"][0]["grabbed_line"] == "biceps_brachii"; }));
  for (int i = 1; i <= 5; ++i) gui.move_to(middle[0] - 4.0 * i, middle[1]);
  EXPECT_TRUE(gui.wait_until([](const json& s) {
    const std::array<double, 3> f = s["frame"]["tools"][0]["force_world_N"];
    return std::hypot(f[0], f[1], f[2]) > 0.2;
  }));
  expect_drawn(gui, "pulled");
  gui.release();
  EXPECT_TRUE(gui.wait_until([](const json& s) { return s["frame"]["tools"][0]["grabbed_line"] == ""; }));
  gui.key("Escape");
  EXPECT_TRUE(gui.wait_until([](const json& s) { return s["frame"]["tools"][0]["forces_stopped"] == true; }));
  gui.key("Return");
  EXPECT_TRUE(gui.wait_until([](const json& s) { return s["frame"]["tools"][0]["forces_stopped"] == false; }));
  gui.key("ctrl+Escape");  // the hand is moved freely with Ctrl
  EXPECT_TRUE(gui.wait_until([](const json& s) { return s["frame"]["tools"][0]["forces_stopped"] == true; }));
}

TEST_F(WindowTest, ANoteStaysWithItsMuscle) {
  GuiProgram gui("note", "elbow --set tissue.default=line");
  gui.click("find.biceps_brachii");
  gui.click("card.note");
  testing::pause_s(1.0);  // until it has the keyboard, in a slow picture too
  gui.type("one head");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.value_of("card.note") == "one head"; }, 5.0));
  gui.click("find.brachialis");
  EXPECT_TRUE(gui.wait_until([&](const json& s) {
    return s["view"]["selected_muscle"] == "brachialis" && gui.value_of("card.note").empty();
  }));
  gui.click("find.biceps_brachii");
  EXPECT_TRUE(gui.wait_until([&](const json&) { return gui.value_of("card.note") == "one head"; }, 5.0));
}

TEST_F(WindowTest, APostureIsHeldRecordedLookedBackOnAndExported) {
  GuiProgram gui("keep", "elbow");
  gui.click("tasks.demonstrate");
  gui.click("demonstrate.preset.firm");
  ASSERT_TRUE(gui.wait_until([](const json& s) { return s["scene"]["common"] == 1.0 && s["scene"]["hold_posture"]; }));
  gui.key("ctrl+r");  // begins the scene again, with what is set
  ASSERT_TRUE(gui.wait_until([](const json& s) { return s["recording"] == true; }, 60.0));
  EXPECT_EQ(gui.state()["scene"]["common"], 1.0);
  EXPECT_TRUE(gui.wait_until([](const json& s) { return s["frame"]["time_s"] > 4.0; }, 60.0));
  EXPECT_LT(std::abs(gui.state()["frame"]["joints"]["elbow"]["angle_rad"].get<double>()), 0.02);  // a degree
  EXPECT_GT(gui.state()["frame"]["joints"]["elbow"]["K_Nm_rad"], 4.0);
  gui.click("news.read");
  gui.click("keep.stop_recording");
  EXPECT_TRUE(gui.wait_until([](const json& s) { return s["recording"] == false; }));
  const auto recordings = std::filesystem::directory_iterator(gui.folder() / "home/data/myotact/recordings");
  const std::string file = recordings->path().string();

  gui.drag_slider("keep.time", 0.98, 0.15);
  ASSERT_TRUE(gui.wait_until([](const json& s) { return s["looking_back"] == true; }));
  EXPECT_LT(gui.state()["frame"]["time_s"], 0.8 * gui.state()["newest_s"].get<double>());
  expect_drawn(gui, "looking_back");
  gui.click("keep.now");
  EXPECT_TRUE(gui.wait_until([](const json& s) { return s["looking_back"] == false; }));

  gui.click("tasks.plots");
  expect_drawn(gui, "plots");
  gui.click("plots.csv");
  gui.click("plots.svg");
  const auto exports = [&] {  // tables and charts that are whole
    int whole = 0;
    const std::filesystem::path folder = gui.folder() / "home/data/myotact/exports";
    if (!std::filesystem::exists(folder)) return whole;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) whole += entry.file_size() > 1000 ? 1 : 0;
    return whole;
  };
  EXPECT_TRUE(gui.wait_until([&](const json&) { return exports() >= 2; }));
  testing::Child replay(std::string(MYOTACT_PROGRAM) + " replay '" + file + "'", gui.folder() / "replay.log");
  EXPECT_EQ(replay.wait(120.0), 0) << "see replay.log";
}

TEST_F(WindowTest, AnotherSceneOpensWhileThisOneGoesOn) {
  GuiProgram gui("scenes", "elbow --set tissue.default=line");
  gui.click("tasks.demonstrate");
  gui.click("demonstrate.scene");
  gui.click("stifle");
  ASSERT_TRUE(gui.wait_until([](const json& s) { return s["opening"] == true || s["scene_name"] == "stifle"; }));
  EXPECT_TRUE(gui.wait_until([](const json& s) { return s["scene_name"] == "stifle"; }, 90.0));
  EXPECT_TRUE(gui.wait_until([](const json& s) { return s["frame"]["time_s"] > 0.2; }, 30.0));
  expect_drawn(gui, "stifle");
}

TEST_F(WindowTest, ADisplayThatGoesAwayEndsTheProgramWithASentenceAndAWholeRecording) {
  const std::string recording = (std::filesystem::path(MYOTACT_GUI_PICTURES) / "display.myorec").string();
  GuiProgram gui("display", "elbow --set tissue.default=line --record " + recording);
  ASSERT_TRUE(gui.wait_until([](const json& s) { return s["frame"]["time_s"] > 1.0; }, 30.0));
  ::kill(gui.display().id(), SIGKILL);
  EXPECT_EQ(gui.program().wait(20.0), 69);
  EXPECT_NE(gui.log().find("the display went away"), std::string::npos) << gui.log();
  testing::Child replay(std::string(MYOTACT_PROGRAM) + " replay " + recording, gui.folder() / "replay.log");
  EXPECT_EQ(replay.wait(120.0), 0) << "see replay.log";
}

TEST_F(WindowTest, AWindowTooSmallForItsPanelsStillShowsTheLimb) {
  GuiProgram gui("small", "elbow --set tissue.default=line");
  gui.resize(200, 150);
  ASSERT_TRUE(gui.wait_until([](const json& state) { return state["scene_box"][2] <= 200.0; }));
  expect_drawn(gui, "small");
  gui.key("2");  // the medial view
  EXPECT_TRUE(gui.wait_until([](const json& state) { return state["view"]["camera"]["azimuth_rad"] < 0.0; }));
  EXPECT_TRUE(gui.program().running()) << gui.log();
}

}  // namespace
}  // namespace myotact
