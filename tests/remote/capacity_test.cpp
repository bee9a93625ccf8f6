#include "remote/capacity.h"

#include <gtest/gtest.h>

namespace myotact::remote {
namespace {

constexpr double kAllowed_s = 8e-3;

TEST(Capacity, LiesBetweenTheNumbersThatWereMeasured) {
  EXPECT_EQ(hands_borne({{0, 2e-3}, {1, 3e-3}, {2, 4e-3}, {4, 6e-3}, {8, 10e-3}}, kAllowed_s, 32), 6u);
  EXPECT_EQ(hands_borne({{0, 7e-3}, {1, 9e-3}}, kAllowed_s, 32), 0u) << "not one hand";
  EXPECT_EQ(hands_borne({{0, 9e-3}}, kAllowed_s, 32), 0u) << "slow without any";
  EXPECT_EQ(hands_borne({{0, 1e-3}, {1, 1e-3}, {2, 1e-3}}, kAllowed_s, 2), 2u);
}

TEST(Capacity, ASceneWithoutSoftMusclesBearsAll) {
  const auto load = measure_load(scene::load_scene("plane"), kAllowed_s, 32);
  EXPECT_TRUE(load.empty());
  EXPECT_EQ(hands_borne(load, kAllowed_s, 32), 32u);
}

TEST(Capacity, MoreHandsTakeLongerAndTheMeasureEndsThere) {
  const scene::Scene scene = scene::load_scene("elbow", {{"tissue.default", "mass_spring"}});
  const auto all = measure_load(scene, 1e9, 16);
  ASSERT_EQ(all.size(), 6u);  // 0, 1, 2, 4, 8, 16
  EXPECT_EQ(all.back().hands, 16u);
  EXPECT_GT(all.back().step_s, all.front().step_s);
  EXPECT_EQ(measure_load(scene, 0.0, 16).size(), 1u) << "the first step already takes longer than no time";
}

}  // namespace
}  // namespace myotact::remote
