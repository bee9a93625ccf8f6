#include "haptics/proxy/half_space_projection.h"

#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace myotact::haptics {
namespace {

constexpr double kTolerance_m = 2e-8;  // stated by the header, twice

Vec3 random_vector(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random)};
}

TEST(HalfSpaceProjection, APointThatIsAllowedStays) {
  const std::vector<HalfSpace> spaces{{Vec3::UnitZ(), 0.0}};
  const Projection result = project_to_half_spaces(Vec3(1, 2, 3), spaces);
  EXPECT_EQ(result.point_m, Vec3(1, 2, 3));
  EXPECT_EQ(result.active_count, 0);
}

TEST(HalfSpaceProjection, ACornerHoldsWithThreeReactions) {
  const std::vector<HalfSpace> spaces{{Vec3::UnitX(), 1e-3}, {Vec3::UnitY(), 2e-3}, {Vec3::UnitZ(), 3e-3}};
  const Projection result = project_to_half_spaces(Vec3::Zero(), spaces);
  EXPECT_NEAR((result.point_m - Vec3(1e-3, 2e-3, 3e-3)).norm(), 0.0, kTolerance_m);
  EXPECT_EQ(result.active_count, 3);
}

TEST(HalfSpaceProjection, FacingSpacesWithoutACommonPointAreInfeasible) {
  const std::vector<HalfSpace> spaces{{Vec3::UnitX(), 1e-3}, {-Vec3::UnitX(), 1e-3}};
  EXPECT_FALSE(project_to_half_spaces(Vec3::Zero(), spaces).feasible);
}

// The closest point is the one that is allowed, and whose pull is made up by pushes of planes that it lies on.
TEST(HalfSpaceProjection, RandomSpacesSatisfyTheOptimalityConditions) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<HalfSpace> spaces;
    const Vec3 common_m = 5e-3 * random_vector(random);
    for (int i = 0; i < 40; ++i) {
      const Vec3 normal = random_vector(random).normalized();
      spaces.push_back({normal, normal.dot(common_m) - 1e-3 * (i % 7)});
    }
    const Vec3 goal_m = 2e-2 * random_vector(random);
    const Projection result = project_to_half_spaces(goal_m, spaces);
    ASSERT_TRUE(result.feasible);
    for (const HalfSpace& space : spaces) ASSERT_GE(space.normal.dot(result.point_m), space.offset_m - kTolerance_m);
    Vec3 pushed_m = goal_m;
    for (int i = 0; i < result.active_count; ++i) {
      const HalfSpace& space = spaces[static_cast<std::size_t>(result.active[static_cast<std::size_t>(i)])];
      ASSERT_GT(result.reaction_m[static_cast<std::size_t>(i)], 0.0);
      ASSERT_NEAR(space.normal.dot(result.point_m), space.offset_m, kTolerance_m);
      pushed_m += result.reaction_m[static_cast<std::size_t>(i)] * space.normal;
    }
    ASSERT_NEAR((pushed_m - result.point_m).norm(), 0.0, kTolerance_m);
  }
}

}  // namespace
}  // namespace myotact::haptics
