#include "view/camera.h"

#include <cmath>

#include <gtest/gtest.h>

#include "view/colour_map.h"

namespace myotact::view {
namespace {

const ViewBox kLimb{{0.1f, 0.03f, 0.0f}, {0.25f, 0.1f, 0.56f}};

TEST(Camera, StandardViewsHoldTheWholeLimb) {
  for (const char* name : {"lateral", "medial", "cranial", "caudal", "dorsal", "palmar"}) {
    for (const float aspect : {0.75f, 1.6f}) {
      const auto camera = standard_view(name, true, kLimb, aspect);
      ASSERT_TRUE(camera.has_value());
      for (int corner = 0; corner < 8; ++corner) {
        const glm::vec4 at((corner & 1) != 0 ? kLimb.lowest_m.x : kLimb.highest_m.x,
                           (corner & 2) != 0 ? kLimb.lowest_m.y : kLimb.highest_m.y,
                           (corner & 4) != 0 ? kLimb.lowest_m.z : kLimb.highest_m.z, 1.0f);
        const glm::vec4 clip = camera->clip_from_world(aspect) * at;
        EXPECT_LE(std::abs(clip.x), clip.w) << name;
        EXPECT_LE(std::abs(clip.y), clip.w) << name;
      }
    }
  }
  EXPECT_FALSE(standard_view("anterior", true, kLimb, 1.0f).has_value());
}

TEST(Camera, LateralViewOfALeftLimbLooksFromTheLeftWithCranialAtTheLeft) {
  const auto camera = standard_view("lateral", true, kLimb, 1.0f);
  EXPECT_GT(camera->eye_world_m().y, kLimb.highest_m.y);
  EXPECT_LT(camera->right_world().x, -0.99f);
}

TEST(Camera, OrbitNeverGoesOverThePole) {
  Camera camera;
  camera.orbit(0.0f, 10.0f);
  EXPECT_LE(camera.elevation_rad, Camera::kSteepest_rad);
  EXPECT_GT(camera.up_world().z, 0.0f);
}

TEST(ColourMap, RisesInBrightnessFromEndToEnd) {
  const auto brightness = [](double level) {
    const glm::vec3 c = cividis(level);
    return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
  };
  for (double level = 0.05; level <= 1.0; level += 0.05) EXPECT_GT(brightness(level), brightness(level - 0.05));
  EXPECT_EQ(cividis(-1.0), cividis(0.0));
}

TEST(Camera, ADevicePushesTheViewAsIfItsCapWereTheLimb) {
  Camera camera{{0.0f, 0.0f, 0.0f}, 0.5f, 0.1f, 1.0f};
  const Camera before = camera;
  push_view(camera, {0.0, 0.0, 0.0}, 0.1f);
  EXPECT_EQ(camera, before);
  push_view(camera, {1.0, 0.0, 0.0}, 0.1f);
  EXPECT_LT(camera.azimuth_rad, before.azimuth_rad) << "to the right, as a drag to the right";
  push_view(camera, {0.0, 1.0, 0.0}, 0.1f);
  EXPECT_LT(camera.elevation_rad, before.elevation_rad);
  push_view(camera, {0.0, 0.0, 1.0}, 0.1f);
  EXPECT_LT(camera.distance_m, before.distance_m) << "towards the person: nearer";
  for (int i = 0; i < 1000; ++i) push_view(camera, {1.0, 1.0, 1.0}, 0.1f);
  EXPECT_GE(camera.elevation_rad, -Camera::kSteepest_rad);
  EXPECT_GT(camera.distance_m, 0.0f);
}

}  // namespace
}  // namespace myotact::view
