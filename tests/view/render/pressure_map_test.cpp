#include "view/render/pressure_map.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "support/synthetic_specimen.h"

namespace myotact::view {
namespace {

TEST(PressureMap, KeepsTheHighestPressureAtEachPlaceUntilItIsWiped) {
  const anatomy::Specimen specimen = myotact::testing::antagonist_hinge();
  PressureMap map(specimen);
  messages::SceneFrame frame;
  for (const auto& muscle : specimen.muscles) {
    frame.skins_world_m.emplace_back();
    for (const Vec3& p : muscle.skin.positions_m) {
      frame.skins_world_m.back().push_back(
          {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
    }
  }
  messages::ToolFrame tool;
  tool.radius_m = 3e-3;
  tool.in_contact = true;
  tool.touched_muscle = 1;
  tool.proxy_world_m = to_array(specimen.muscles[1].skin.positions_m[5]);
  tool.force_world_N = {0.0, 0.6, 0.8};
  frame.tools = {tool};
  EXPECT_NEAR(pressure_Pa(tool), 35367.8, 0.1);  // 1 N over pi (3 mm)^2
  map.add(frame);
  EXPECT_NEAR(map.peaks_Pa()[1][5], 35367.8f, 1.0f);
  EXPECT_EQ(*std::max_element(map.peaks_Pa()[0].begin(), map.peaks_Pa()[0].end()), 0.0f);
  frame.tools[0].force_world_N = {0.0, 0.1, 0.0};
  map.add(frame);
  EXPECT_NEAR(map.peaks_Pa()[1][5], 35367.8f, 1.0f);
  frame.tools[0].in_contact = false;
  EXPECT_EQ(pressure_Pa(frame.tools[0]), 0.0);
  map.clear();
  map.add(frame);
  EXPECT_TRUE(map.empty());
}

}  // namespace
}  // namespace myotact::view
