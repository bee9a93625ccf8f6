#include "view/pictures/turntable.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/error.h"

namespace myotact::view {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

TEST(Turntable, EachStepIsAlikeAndTheLastLeadsToTheFirst) {
  Camera start;
  start.azimuth_rad = 0.5f * kPi;
  start.elevation_rad = 0.2f;
  const ViewBox box{{-0.1f, -0.2f, 0.0f}, {0.3f, 0.1f, 0.6f}};
  const std::vector<Camera> cameras = cameras_round(start, box, 1.5f, 50);
  ASSERT_EQ(cameras.size(), 50u);
  EXPECT_NEAR(cameras[0].azimuth_rad, start.azimuth_rad, 1e-6f);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const Camera& next = cameras[(i + 1) % cameras.size()];
    const float step_rad = std::remainder(next.azimuth_rad - cameras[i].azimuth_rad, 2.0f * kPi);
    EXPECT_NEAR(step_rad, 2.0f * kPi / 50.0f, 1e-5f);
    EXPECT_EQ(next.distance_m, cameras[i].distance_m);
    EXPECT_EQ(next.target_world_m, cameras[i].target_world_m);
    EXPECT_EQ(next.elevation_rad, start.elevation_rad);
  }
}

TEST(Turntable, TheWholeBoxIsInEveryPicture) {
  const ViewBox box{{-0.3f, -0.02f, 0.0f}, {0.3f, 0.02f, 0.2f}};
  constexpr float kAspect = 0.8f;
  for (const Camera& camera : cameras_round({}, box, kAspect, 30)) {
    for (int corner = 0; corner < 8; ++corner) {
      const glm::vec4 at((corner & 1) != 0 ? box.highest_m.x : box.lowest_m.x,
                         (corner & 2) != 0 ? box.highest_m.y : box.lowest_m.y,
                         (corner & 4) != 0 ? box.highest_m.z : box.lowest_m.z, 1.0f);
      const glm::vec4 clip = camera.clip_from_world(kAspect) * at;
      EXPECT_LE(std::abs(clip.x), clip.w);
      EXPECT_LE(std::abs(clip.y), clip.w);
    }
  }
}

TEST(Turntable, SizesThatVideoDoesNotTakeAreRefused) {
  EXPECT_NO_THROW(check_film_size({1920, 1080}));
  EXPECT_THROW(check_film_size({1921, 1080}), Error);
  EXPECT_THROW(check_film_size({1920, 8192}), Error);
}

}  // namespace
}  // namespace myotact::view
