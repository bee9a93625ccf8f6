#include "view/render/tool_drawing.h"

#include <gtest/gtest.h>

namespace myotact::view {
namespace {

// Where a tool is drawn whose hand feels nothing.

class ToolHeldBack : public ::testing::Test {
 protected:
  ToolHeldBack() {
    frame_.lines_world_m = {{{0.0, 0.0, 0.0}, {0.2, 0.0, 0.0}}};
    tool_.radius_m = 3e-3;
    tool_.tool_world_m = tool_.proxy_world_m = {0.1, 0.03, 0.0};  // 30 mm beside the line
    tool_.grabbed_line = 0;
  }

  DrawMesh drawn() const {
    DrawMesh mesh;
    add_tool_held_back(mesh, tool_, frame_, glm::vec3(0.0f, -1.0f, 0.0f));
    return mesh;
  }

  /// Middle of what has the tool's colour.
  glm::vec3 place_m() const {
    glm::vec3 sum(0.0f);
    float count = 0.0f;
    for (const DrawVertex& vertex : drawn().vertices) {
      if (glm::vec3(vertex.colour) != tool_colour(tool_)) continue;
      sum += vertex.position;
      count += 1.0f;
    }
    return sum / count;
  }

  /// Along y, of all that is dark: the hand and what joins it to the tool.
  float reach_m() const {
    float low = 1.0f, high = -1.0f;
    for (const DrawVertex& vertex : drawn().vertices) {
      if (vertex.colour != kThread) continue;
      low = std::min(low, vertex.position.y);
      high = std::max(high, vertex.position.y);
    }
    return high - low;
  }

  messages::SceneFrame frame_;
  messages::ToolFrame tool_;
};

TEST_F(ToolHeldBack, LagsWithTheForceOfTheLineInHand) {
  const float hand_m = reach_m();  // no force: the hand alone
  EXPECT_NEAR(place_m().y, 0.03f, 1e-5f);
  for (const double force_N : {0.6, 3.0, 6.0}) {
    tool_.parts.line = {0.0, -force_N, 0.0};
    const auto lag_m = static_cast<float>(force_N / 300.0);  // of the simulated grip
    EXPECT_NEAR(place_m().y, 0.03f - lag_m, 1e-5f) << force_N;
    EXPECT_GT(reach_m(), lag_m) << force_N;
    EXPECT_LT(reach_m(), lag_m + hand_m + 1e-5f) << force_N;
  }
}

TEST_F(ToolHeldBack, DoesNotLagBeyondTheLineHoweverStiffItIs) {
  tool_.parts.line = {0.0, -200.0, 0.0};
  EXPECT_NEAR(place_m().y, 0.0f, 1e-5f);
  EXPECT_NEAR(place_m().x, 0.1f, 1e-5f);
  tool_.parts.line = {};
  tool_.tool_world_m = {0.3, 0.0, 0.0};  // beyond an end
  tool_.parts.line = {-200.0, 0.0, 0.0};
  EXPECT_NEAR(place_m().x, 0.2f, 1e-5f);
}

TEST_F(ToolHeldBack, LagsByTheSimulatedForceAndNotTheFeltOne) {
  tool_.force_scale = 0.5;
  tool_.parts.line = {0.0, -1.5, 0.0};
  EXPECT_NEAR(place_m().y, 0.03f - 0.01f, 1e-5f);
}

TEST_F(ToolHeldBack, StaysOnTheSurfaceThatItTouches) {
  tool_.grabbed_line = -1;
  tool_.in_contact = true;
  tool_.tool_world_m = {0.1, 0.026, 0.0};  // pressed in by 4 mm
  tool_.parts.contact = {0.0, 3.0, 0.0};
  EXPECT_NEAR(place_m().y, 0.03f, 1e-5f);
  EXPECT_GT(reach_m(), 4e-3f);
}

TEST_F(ToolHeldBack, IsDrawnWhereTheHandIsWhenItsLineIsNotInTheFrame) {
  tool_.parts.line = {0.0, -3.0, 0.0};
  frame_.lines_world_m.clear();
  EXPECT_NEAR(place_m().y, 0.03f, 1e-5f);
}

}  // namespace
}  // namespace myotact::view
