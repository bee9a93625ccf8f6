#include "measure/fidelity/felt_masks.h"

#include <vector>

#include <gtest/gtest.h>

namespace myotact::measure {
namespace {

TEST(ComparedTicks, AreThoseWithAnOpenGateAStillHandAndAForceWithinTheLimit) {
  scene::Scene scene;
  scene.tools.resize(1);
  scene.tools[0].force_limit = 0.5;
  device::DeviceProfile profile;
  profile.peak_force_N = 6.0;
  DeviceRun run;
  std::vector<Vec3> true_N;
  for (int i = 0; i < 1000; ++i) {
    const double force_N = i >= 750 && i < 760 ? 3.0 : 2.999;  // the limit itself is over
    true_N.emplace_back(force_N * Vec3(0.6, 0.0, -0.8));
    haptics::HapticTick& tick = run.ticks.emplace_back();
    tick.gate = haptics::GateState::On;
    if (i < 50) tick.gate = haptics::GateState::Ramp;
    if (i >= 340 && i < 350) tick.gate = haptics::GateState::Fade;  // while the hand closes
    if (i >= 300 && i < 500) tick.tool.grabbed_line = 2;
    if (i >= 500 && i < 620) tick.tool.grabbed_body = 1;  // from the line to a bone, and from that to the air
  }
  const ComparedTicks found = compared_ticks(scene, run, profile, true_N);
  ASSERT_EQ(found.compared.size(), 1000u);
  for (std::size_t i = 0; i < 1000; ++i) {
    const bool expected = i >= 50 && !(i >= 299 && i < 420) && !(i >= 499 && i < 740) && !(i >= 750 && i < 760);
    EXPECT_EQ(found.compared[i], expected) << i;
  }
  EXPECT_EQ(found.gate, 60u);
  EXPECT_EQ(found.hand, 350u);  // three changes of 120 ticks, less where the gate was shut
  EXPECT_EQ(found.at_limit, 10u);
  true_N.resize(200);  // a truth that is shorter than the run
  EXPECT_EQ(compared_ticks(scene, run, profile, true_N).compared.size(), 200u);
}

}  // namespace
}  // namespace myotact::measure
