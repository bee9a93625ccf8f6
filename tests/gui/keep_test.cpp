#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gui/gui_program.h"

// What a person keeps: the last minutes on the timeline, tables of the plots, pictures.

namespace myotact {
namespace {

using nlohmann::json;
using testing::GuiProgram;

class KeepTest : public testing::GuiTest {};

std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder, const std::string& extension) {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == extension) found.push_back(entry.path());
  }
  return found;
}

double shown_time_s(const GuiProgram& gui) {
  return std::stod(gui.value_of("keep.time"));
}

TEST_F(KeepTest, LookingBackStaysInThePastWhileTheSimulationGoesOn) {
  GuiProgram gui("timeline", "elbow");
  ASSERT_TRUE(gui.wait_until([](const json& state) { return state["frame"]["time_s"] > 3.0; }));
  gui.drag_slider("keep.time", 0.95, 0.4);
  testing::pause_s(0.5);
  const double past_s = shown_time_s(gui);
  const double now_s = gui.state()["newest_s"];
  EXPECT_LT(past_s, 0.7 * now_s);
  ASSERT_TRUE(gui.wait_until([&](const json& state) { return state["newest_s"] > now_s + 0.5; }));
  EXPECT_EQ(shown_time_s(gui), past_s);
  gui.key("Left");
  EXPECT_TRUE(gui.wait_until([&](const json&) { return shown_time_s(gui) < past_s; }));
  gui.click("keep.now");
  EXPECT_TRUE(gui.wait_until([&](const json&) { return shown_time_s(gui) > now_s; }));
}

TEST_F(KeepTest, APersonGoesOnFromAnEarlierMomentAndTakesThatBack) {
  GuiProgram gui("go_on", "elbow --set tissue.default=line");
  const auto angle_rad = [](const json& state) { return state["frame"]["joints"]["elbow"]["angle_rad"].get<double>(); };
  ASSERT_TRUE(gui.wait_until([](const json& state) { return state["frame"]["time_s"] > 2.0; }));
  const double then_rad = angle_rad(gui.state());
  gui.click("tasks.demonstrate");
  gui.drag_slider("demonstrate.difference", 0.5, 0.9);
  ASSERT_TRUE(gui.wait_until([&](const json& state) { return std::abs(angle_rad(state) - then_rad) > 0.1; }));
  const double now_s = gui.state()["newest_s"];
  ASSERT_TRUE(gui.wait_until([&](const json& state) { return state["newest_s"] > now_s + 1.0; }));
  const double gone_rad = angle_rad(gui.state());
  gui.drag_slider("keep.time", 0.95, 0.05);
  ASSERT_TRUE(gui.wait_until([&](const json& state) { return std::abs(angle_rad(state) - then_rad) < 0.02; }));
  gui.click("keep.go_on");
  EXPECT_TRUE(gui.wait_until([&](const json& state) {
    return state["newest_s"] == state["frame"]["time_s"] && state["scene"]["difference"] == 0.0 &&
           std::abs(angle_rad(state) - then_rad) < 0.02;
  }));
  gui.screenshot("went_on");
  gui.click("toolbar.undo");
  EXPECT_TRUE(gui.wait_until([&](const json& state) {
    return state["scene"]["difference"] > 0.1 && std::abs(angle_rad(state) - gone_rad) < 0.05;
  }));
  gui.click("toolbar.redo");
  EXPECT_TRUE(gui.wait_until([&](const json& state) {
    return state["scene"]["difference"] == 0.0 && std::abs(angle_rad(state) - then_rad) < 0.02;
  }));
}

TEST_F(KeepTest, TablesAndPicturesGoIntoThePersonsOwnFolder) {
  GuiProgram gui("tables", "elbow --set tissue.default=line");
  const std::filesystem::path own = gui.folder() / "home";
  ASSERT_TRUE(gui.wait_until([](const json& state) { return state["frame"]["time_s"] > 0.5; }));
  gui.click("tasks.plots");
  gui.click("plots.csv");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return files_below(own, ".csv").size() == 1; }));
  std::string header;
  std::getline(std::ifstream(files_below(own, ".csv")[0]), header);
  EXPECT_EQ(header,
            "time_s,elbow_angle_deg,elbow_stiffness_Nm_rad,elbow_torque_Nm,tool_force_N,tool_contact_N,tool_friction_N,"
            "tool_texture_N,tool_line_N,tool_bone_N,tool_tether_N,tool_damping_N,tool_limits_N");
  gui.key("ctrl+p");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return files_below(own, ".png").size() == 1; }));
  EXPECT_GT(testing::colours_in(files_below(own, ".png")[0], {0, 0, 1280, 800}), 200);
}

/// Films for some seconds. Returns what stands in the status line then.
std::string film_with(GuiProgram& gui) {
  EXPECT_TRUE(gui.wait_until([](const json& state) { return state["frame"]["time_s"] > 0.5; }));
  gui.click("keep.film");
  EXPECT_TRUE(gui.wait_until([](const json& state) { return state["filming"] == true; }));
  testing::pause_s(2.0);
  gui.key("ctrl+shift+r");
  EXPECT_TRUE(gui.wait_until([](const json& state) { return state["filming"] == false; }));
  EXPECT_TRUE(gui.wait_until([&](const json&) { return !gui.value_of("news.message").empty(); }));
  return gui.value_of("news.message");
}

void put_ffmpeg(const std::filesystem::path& folder, const std::string& script) {
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "ffmpeg") << "#!/bin/sh\nfor last; do :; done\n" << script << "\n";
  std::filesystem::permissions(folder / "ffmpeg", std::filesystem::perms::owner_all);
}

TEST_F(KeepTest, AFilmGoesIntoThePersonsOwnFolder) {
  const std::filesystem::path tools = std::filesystem::path(MYOTACT_GUI_PICTURES) / "film_tools";
  put_ffmpeg(tools, "cat > \"$last\"");
  GuiProgram gui("film", "elbow --set tissue.default=line", "PATH=" + tools.string() + ":$PATH");
  const std::string told = film_with(gui);
  const auto films = files_below(gui.folder() / "home", ".mp4");
  ASSERT_EQ(films.size(), 1u) << told;
  EXPECT_NE(told.find(films[0].string()), std::string::npos) << told;
  const std::array<double, 4> box = gui.state()["scene_box"];
  const auto even = [](double length) { return static_cast<std::uintmax_t>(length) / 2 * 2; };
  const std::uintmax_t picture = even(box[2]) * even(box[3]) * 3;
  EXPECT_EQ(std::filesystem::file_size(films[0]) % picture, 0u);
  EXPECT_GE(std::filesystem::file_size(films[0]) / picture, 25u);  // a second and more of what took two
}

TEST_F(KeepTest, AnFfmpegThatDiesEndsTheFilmAndNothingElse) {
  const std::filesystem::path tools = std::filesystem::path(MYOTACT_GUI_PICTURES) / "film_dies_tools";
  put_ffmpeg(tools, "exit 1");
  GuiProgram gui("film_dies", "elbow --set tissue.default=line", "PATH=" + tools.string() + ":$PATH");
  gui.click("keep.film");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return !gui.value_of("news.message").empty(); }));
  EXPECT_NE(gui.value_of("news.message").find("ffmpeg"), std::string::npos) << gui.value_of("news.message");
  EXPECT_TRUE(files_below(gui.folder() / "home", ".mp4").empty());
  const double then_s = gui.state()["newest_s"];
  EXPECT_TRUE(gui.wait_until([&](const json& state) { return state["newest_s"] > then_s + 0.2; }));
}

double replayed_s(const GuiProgram& gui) {
  const json state = gui.state();
  return state["frame"]["time_s"];
}

TEST_F(KeepTest, ARecordingIsPlayedAgainInTheWindow) {
  GuiProgram gui("replay", "elbow --set tissue.default=line");
  gui.key("ctrl+r");
  ASSERT_TRUE(gui.wait_until([](const json& s) { return s["recording"] == true && s["frame"]["time_s"] > 3.0; }));
  const double angle_rad = gui.state()["frame"]["joints"]["elbow"]["angle_rad"];
  gui.key("ctrl+r");
  ASSERT_TRUE(gui.wait_until([](const json& s) { return s["recording"] == false; }));
  gui.click("keep.recordings");
  gui.click("keep.recording.0");
  ASSERT_TRUE(gui.wait_until([](const json& s) { return s["replay_s"] > 2.9; }));
  EXPECT_TRUE(gui.wait_until([&](const json&) { return replayed_s(gui) > 0.5; }));  // plays at once
  gui.click("keep.replay_pause");
  const double paused_s = replayed_s(gui);
  testing::pause_s(0.5);
  EXPECT_EQ(replayed_s(gui), paused_s);
  gui.screenshot("paused");
  gui.key("Left");
  EXPECT_TRUE(gui.wait_until([&](const json&) { return replayed_s(gui) < paused_s; }));
  gui.drag_slider("keep.replay_time", 0.2, 0.98);  // to what was not simulated yet
  EXPECT_TRUE(gui.wait_until([&](const json&) { return replayed_s(gui) > 2.5; }));
  const double then_rad = gui.state()["frame"]["joints"]["elbow"]["angle_rad"];
  EXPECT_NEAR(then_rad, angle_rad, 0.2);  // of the same motion
  gui.drag_slider("keep.replay_time", 0.98, 0.1);
  EXPECT_TRUE(gui.wait_until([&](const json&) { return replayed_s(gui) < 1.0; }));
  gui.click("keep.to_scene");
  EXPECT_TRUE(gui.wait_until([](const json& s) { return s["replay_s"] == 0.0 && s["frame"]["time_s"] > 0.1; }));
}

TEST_F(KeepTest, OneRecordingFollowsAnother) {
  GuiProgram gui("record_again", "spring");
  for (int time = 0; time < 2; ++time) {
    gui.key("ctrl+r");
    ASSERT_TRUE(gui.wait_until(
        [](const json& s) { return s["recording"] == true && s["opening"] == false && s["frame"]["time_s"] > 0.3; }));
    testing::pause_s(0.5);
    EXPECT_EQ(gui.state()["recording"], true) << time;
    gui.key("ctrl+r");
    ASSERT_TRUE(gui.wait_until([](const json& s) { return s["recording"] == false; }));
  }
}

TEST_F(KeepTest, ADamagedRecordingIsSaidAndTheSceneGoesOn) {
  GuiProgram gui("replay_damaged", "elbow --set tissue.default=line");
  const std::filesystem::path folder = gui.folder() / "home/data/myotact/recordings";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "foreign.myorec") << "no recording at all";
  gui.click("keep.recordings");
  gui.click("keep.recording.0");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return !gui.value_of("news.message").empty(); }));
  EXPECT_NE(gui.value_of("news.message").find("is no recording"), std::string::npos);
  const double then_s = gui.state()["newest_s"];
  EXPECT_TRUE(gui.wait_until([&](const json& state) { return state["newest_s"] > then_s + 0.2; }));
}

}  // namespace
}  // namespace myotact
