#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gui/gui_program.h"

// The scenes of the older research system at the window: there is nothing to touch, only a spring to draw out.

namespace myotact {
namespace {

using nlohmann::json;
using testing::GuiProgram;

class SpringSceneTest : public testing::GuiTest {};

double force_N(const json& state) {
  const std::array<double, 3> force = state["frame"]["tools"][0]["force_world_N"];
  return std::hypot(force[0], force[1], force[2]);
}

TEST_F(SpringSceneTest, ADragDrawsTheSpringOut) {
  GuiProgram gui("particle", "particle");
  ASSERT_TRUE(gui.wait_until([](const json& s) { return s["frame"]["time_s"] > 1.5; }));  // the ramp
  EXPECT_LT(force_N(gui.state()), 0.01);
  gui.click("toolbar.touch");
  const std::array<double, 4> box = gui.state()["scene_box"];
  const double x = box[0] + 0.5 * box[2], y = box[1] + 0.3 * box[3];
  gui.move_to(x, y);
  gui.press();
  gui.move_to(x + 60.0, y - 60.0);
  EXPECT_TRUE(gui.wait_until([](const json& s) { return force_N(s) > 0.3; }));
  // The particle swings: what the panel says is of another moment than the force above.
  EXPECT_TRUE(gui.wait_until([&](const json&) {
    const std::string tether_N = gui.value_of("feel.part.tether");
    return !tether_N.empty() && std::stod(tether_N) > 0.3;
  }));
  gui.screenshot("drawn_out");
  gui.release();
  testing::pause_s(1.0);
  EXPECT_GT(force_N(gui.state()), 0.3);  // the tool stays where it is put
}

}  // namespace
}  // namespace myotact
