#include <filesystem>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gui/gui_program.h"

// A student goes through lessons at the window.

namespace myotact {
namespace {

using nlohmann::json;
using testing::GuiProgram;
using ::testing::HasSubstr;

class LearnGui : public testing::GuiTest {};

/// A folder of data with a quiz, one that is cut off, and later the results.
std::filesystem::path data_with_quizzes() {
  const std::filesystem::path data = std::filesystem::path(MYOTACT_GUI_PICTURES) / "learn_data";
  std::filesystem::remove_all(data);
  std::filesystem::create_directories(data / "myotact" / "lessons");
  std::ofstream(data / "myotact" / "lessons" / "cut.json") << R"({"schema": 1, "key": "cut)";
  std::ofstream(data / "myotact" / "lessons" / "quiz.json") << R"({
    "schema": 1, "key": "quiz", "title": "A quiz", "scene": "elbow", "steps": [
    {"title": "Read", "text": "All of it.", "view": "medial", "show": {"muscles": ["brachialis"]}},
    {"title": "Choose", "text": "Which bone is it?", "hints": ["Not the radius."],
     "task": {"kind": "name", "part": "ulna", "options": ["radius", "ulna"]}},
    {"title": "Type", "text": "Its name?", "task": {"kind": "name", "part": "brachialis"}}]})";
  return data;
}

TEST_F(LearnGui, AQuizOfOnesOwnIsAnsweredAndItsResultsAreKept) {
  const auto data = data_with_quizzes();
  GuiProgram gui("learn_quiz", "elbow --set tissue.default=line", "XDG_DATA_HOME=" + data.string());
  gui.click("tasks.learn");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.shows("learn.refresh"); }));
  gui.screenshot("list");
  gui.click("learn.start.quiz");
  ASSERT_TRUE(gui.wait_until([](const json& state) { return state["view"]["hidden_muscles"].size() == 6; }));
  EXPECT_TRUE(gui.wait_until([](const json& state) { return state["view"]["camera"]["azimuth_rad"] < 0.0; }));
  gui.click("learn.next");
  gui.click("learn.option.radius");
  gui.click("learn.hint");
  gui.screenshot("wrong");
  gui.click("learn.option.ulna");
  gui.click("learn.next");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.shows("learn.typed"); }));
  EXPECT_EQ(gui.state()["view"]["selected_muscle"], "brachialis");
  gui.click("learn.typed");
  gui.type("M. brachialis");
  gui.click("learn.answer");
  gui.click("learn.next");
  gui.click("learn.student");
  gui.type("Ada L");
  gui.click("learn.save");
  const auto file = data / "myotact" / "results" / "Ada_L_quiz.csv";
  ASSERT_TRUE(gui.wait_until([&](const json&) { return std::filesystem::exists(file); }));
  gui.screenshot("results");
  std::ifstream in(file);
  const std::string csv((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  EXPECT_THAT(csv, HasSubstr("quiz,2,name,ulna,1,2,1,"));
  EXPECT_THAT(csv, HasSubstr("quiz,3,name,M. brachialis,1,1,0,"));
  gui.click("learn.close");
  EXPECT_TRUE(gui.wait_until([](const json& state) { return state["view"]["hidden_muscles"].empty(); }));
}

/// With the left button down at a muscle, moved by a few pixels a time.
void hold_at(GuiProgram& gui, const std::string& muscle, double step_px) {
  const auto place = gui.place_of("muscles", muscle);
  gui.move_to(place[0], place[1]);
  testing::pause_s(1.0);
  gui.press();
  testing::pause_s(1.5);
  for (int i = 1; i <= 20; ++i) gui.move_to(place[0] + step_px * i, place[1]);
}

TEST_F(LearnGui, TheMouseTouchesPressesAndPulls) {
  const auto data = data_with_quizzes();
  std::ofstream(data / "myotact" / "lessons" / "hands.json") << R"({
    "schema": 1, "key": "hands", "title": "Hands", "scene": "elbow", "steps": [
    {"title": "a", "text": "t", "view": "lateral", "task": {"kind": "touch", "part": "triceps_brachii_long"}},
    {"title": "b", "text": "t", "view": "lateral",
     "task": {"kind": "press", "muscle": "triceps_brachii_long", "band_N": [0.05, 3], "hold_s": 0.5}},
    {"title": "c", "text": "t", "view": "medial", "set": {"hold_posture": false},
     "task": {"kind": "predict", "muscle": "biceps_brachii", "joint": "elbow", "motion": "flexion"}}]})";
  GuiProgram gui("learn_hands", "elbow", "XDG_DATA_HOME=" + data.string());
  gui.click("tasks.learn");
  gui.click("learn.start.hands");
  for (int step = 0; step < 2; ++step) {
    testing::pause_s(1.0);  // until the camera has come round
    hold_at(gui, "triceps_brachii_long", 0.0);
    EXPECT_TRUE(gui.wait_until([&](const json&) { return gui.shows("learn.next"); })) << "step " << step;
    gui.screenshot("touched");
    gui.release();
    gui.click("learn.next");
  }
  gui.click("learn.flexion");
  testing::pause_s(1.0);
  hold_at(gui, "biceps_brachii", 4.0);  // cranially: to the right in the medial view
  EXPECT_TRUE(gui.wait_until([&](const json&) { return gui.shows("learn.next"); }));
  gui.screenshot("pulled");
  gui.release();
}

TEST_F(LearnGui, ALessonOfAnotherSceneOpensIt) {
  GuiProgram gui("learn_scene", "elbow --set tissue.default=line");
  gui.click("tasks.learn");
  gui.click("learn.open_scene.5_hock");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.shows("learn.start.5_hock"); }, 90.0));
  gui.screenshot("opened");
  gui.click("learn.start.5_hock");
  EXPECT_TRUE(gui.wait_until([&](const json&) { return gui.shows("learn.next"); }));
}

TEST_F(LearnGui, TheElbowIsStiffenedInItsLesson) {
  GuiProgram gui("learn_stiffen", "elbow");
  gui.click("tasks.learn");
  gui.click("learn.start.3_co_contraction");
  gui.click("learn.next");
  gui.click("learn.leave_out");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return gui.shows("learn.stiffness"); })) << "it comes to rest";
  gui.drag_slider("learn.common", 0.02, 0.75);
  EXPECT_TRUE(gui.wait_until([&](const json&) { return gui.shows("learn.next"); }, 30.0)) << "three times as stiff";
  gui.screenshot("stiff");
}

}  // namespace
}  // namespace myotact
