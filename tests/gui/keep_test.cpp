#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "gui/gui_program.h"

// What a person keeps: the last minutes on the timeline, tables of the plots, pictures.

namespace myotact {
namespace {

using nlohmann::json;
using testing::GuiProgram;

class KeepTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string missing = testing::missing_tools(); !missing.empty()) {
      GTEST_SKIP() << "not installed:" << missing << " (packages xvfb, xdotool, imagemagick)";
    }
  }
};

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

TEST_F(KeepTest, TablesAndPicturesGoIntoThePersonsOwnFolder) {
  GuiProgram gui("tables", "elbow");
  const std::filesystem::path own = gui.folder() / "home";
  ASSERT_TRUE(gui.wait_until([](const json& state) { return state["frame"]["time_s"] > 0.5; }));
  gui.click("tasks.plots");
  gui.click("plots.csv");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return files_below(own, ".csv").size() == 1; }));
  std::string header;
  std::getline(std::ifstream(files_below(own, ".csv")[0]), header);
  EXPECT_EQ(header,
            "time_s,elbow_angle_deg,elbow_stiffness_Nm_rad,elbow_torque_Nm,tool_force_N,tool_contact_N,tool_friction_N,"
            "tool_texture_N,tool_line_N,tool_bone_N,tool_damping_N,tool_limits_N");
  gui.key("ctrl+p");
  ASSERT_TRUE(gui.wait_until([&](const json&) { return files_below(own, ".png").size() == 1; }));
  EXPECT_GT(testing::colours_in(files_below(own, ".png")[0], {0, 0, 1280, 800}), 200);
}

}  // namespace
}  // namespace myotact
