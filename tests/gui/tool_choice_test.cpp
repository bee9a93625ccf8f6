#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gui/gui_program.h"

// The tool that a person chooses in the window is the one in the hand and the one that is drawn.

namespace myotact {
namespace {

using nlohmann::json;
using testing::GuiProgram;

class ToolChoice : public testing::GuiTest {};

bool holds(const GuiProgram& gui, double radius_m) {
  return gui.wait_until([&](const json& state) { return state["frame"]["tools"].at(0)["radius_m"] == radius_m; });
}

bool shows(const GuiProgram& gui, const char* tool) {
  return gui.wait_until([&](const json&) { return gui.value_of("feel.tool") == tool; });
}

TEST_F(ToolChoice, APointIsChosenAndTakenBack) {
  GuiProgram gui("tool_choice", "elbow --set tissue.default=line");
  gui.click("tasks.feel");
  ASSERT_TRUE(shows(gui, "feel.tool.ball"));
  const double own_m = gui.state()["frame"]["tools"].at(0)["radius_m"];
  gui.click("feel.tool");
  gui.click("feel.tool.point");
  EXPECT_TRUE(holds(gui, 0.5e-3));
  EXPECT_TRUE(shows(gui, "feel.tool.point"));
  gui.screenshot("point");
  gui.click("feel.tool");
  gui.click("feel.tool.clamp");
  EXPECT_TRUE(shows(gui, "feel.tool.clamp"));
  EXPECT_TRUE(holds(gui, 3e-3));
  gui.screenshot("clamp");
  gui.click("toolbar.undo");
  EXPECT_TRUE(holds(gui, 0.5e-3));
  gui.click("toolbar.undo");
  EXPECT_TRUE(holds(gui, own_m));
  EXPECT_TRUE(shows(gui, "feel.tool.ball"));
}

}  // namespace
}  // namespace myotact
