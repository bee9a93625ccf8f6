#include "view/look/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "view/charts/colour_map.h"

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

TEST(Camera, StandardViewsLeaveNoMoreThanASmallMargin) {
  for (const char* name : {"lateral", "medial", "cranial", "caudal", "dorsal", "palmar"}) {
    for (const float aspect : {0.3f, 0.75f, 1.6f, 4.0f}) {
      const auto camera = standard_view(name, false, kLimb, aspect);
      float widest = 0.0f;
      for (int corner = 0; corner < 8; ++corner) {
        const glm::vec4 at((corner & 1) != 0 ? kLimb.lowest_m.x : kLimb.highest_m.x,
                           (corner & 2) != 0 ? kLimb.lowest_m.y : kLimb.highest_m.y,
                           (corner & 4) != 0 ? kLimb.lowest_m.z : kLimb.highest_m.z, 1.0f);
        const glm::vec4 clip = camera->clip_from_world(aspect) * at;
        widest = std::max({widest, std::abs(clip.x / clip.w), std::abs(clip.y / clip.w)});
      }
      EXPECT_LT(widest, 1.0f) << name << " " << aspect;
      EXPECT_GT(widest, 0.85f) << name << " " << aspect;
    }
  }
}

TEST(Camera, TheLateralViewOfARightLimbLooksFromTheRightWithCranialAtTheRight) {
  const auto lateral = standard_view("lateral", false, kLimb, 1.0f),
             medial = standard_view("medial", false, kLimb, 1.0f);
  EXPECT_LT(lateral->eye_world_m().y, kLimb.lowest_m.y);
  EXPECT_GT(lateral->right_world().x, 0.99f);
  EXPECT_GT(medial->eye_world_m().y, kLimb.highest_m.y);
  for (const bool left : {true, false}) {  // what is the same for both
    EXPECT_GT(standard_view("cranial", left, kLimb, 1.0f)->eye_world_m().x, kLimb.highest_m.x);
    EXPECT_LT(standard_view("caudal", left, kLimb, 1.0f)->eye_world_m().x, kLimb.lowest_m.x);
    EXPECT_GT(standard_view("dorsal", left, kLimb, 1.0f)->eye_world_m().z, kLimb.highest_m.z);
    EXPECT_LT(standard_view("palmar", left, kLimb, 1.0f)->eye_world_m().z, kLimb.lowest_m.z);
  }
}

TEST(Camera, APartOfNoSizeIsStillSeenFromOutside) {
  const glm::vec3 point(0.1f, 0.2f, 0.3f);
  const Camera camera = framed(Camera{}, {point, point}, 1.5f);
  EXPECT_EQ(camera.target_world_m, point);
  EXPECT_GT(camera.distance_m, 0.01f);
  EXPECT_LT(camera.distance_m, 0.2f);
}

TEST(Camera, ADragTakesThePictureAlongByItsShareOfTheHeight) {
  for (const float azimuth : {0.0f, 2.0f, -1.1f}) {
    Camera camera{{0.2f, -0.1f, 0.4f}, azimuth, 0.4f, 0.7f};
    const glm::vec4 there(camera.target_world_m, 1.0f);
    camera.pan(0.25f, -0.1f);
    const glm::vec4 clip = camera.clip_from_world(1.5f) * there;
    EXPECT_NEAR(clip.x / clip.w * 1.5f, 2.0f * 0.25f, 1e-4f);  // a picture is 2 high, from -1 to 1
    EXPECT_NEAR(clip.y / clip.w, 2.0f * -0.1f, 1e-4f);
    EXPECT_EQ(camera.distance_m, 0.7f);
    EXPECT_EQ(camera.azimuth_rad, azimuth);
  }
}

TEST(Camera, ComesNoNearerAndGoesNoFartherThanItMay) {
  Camera camera{{0.0f, 0.0f, 0.0f}, 0.0f, 0.0f, 0.5f};
  camera.zoom(0.8f);
  EXPECT_FLOAT_EQ(camera.distance_m, 0.4f);
  for (int i = 0; i < 1000; ++i) camera.zoom(0.5f);
  EXPECT_FLOAT_EQ(camera.distance_m, 0.02f);
  for (int i = 0; i < 1000; ++i) camera.zoom(2.0f);
  EXPECT_FLOAT_EQ(camera.distance_m, 20.0f);
  camera.zoom(0.5f);
  EXPECT_FLOAT_EQ(camera.distance_m, 10.0f) << "and back at once";
}

TEST(Camera, ManyTurnsAreAsGoodAsOne) {
  Camera camera;
  for (int i = 0; i < 4000; ++i) camera.orbit(0.9f, 0.0f);
  EXPECT_LE(std::abs(camera.azimuth_rad), std::numbers::pi_v<float> + 1e-6f);
  EXPECT_NEAR(std::cos(camera.azimuth_rad), std::cos(3600.0), 0.02);  // 4000 roundings of 1e-7
  EXPECT_NEAR(std::sin(camera.azimuth_rad), std::sin(3600.0), 0.02);
}

TEST(Camera, ItsAxesAreARightHandedFrameFromEverySide) {
  for (float azimuth = -3.1f; azimuth < 3.2f; azimuth += 0.7f) {
    for (const float elevation : {-Camera::kSteepest_rad, -0.6f, 0.0f, 1.2f, Camera::kSteepest_rad}) {
      const Camera camera{{0.0f, 0.0f, 0.0f}, azimuth, elevation, 1.0f};
      const auto axes = axes_of(camera);
      const auto& [right, up, near] = axes;
      EXPECT_NEAR(right[2], 0.0, 1e-6) << "never rolls";
      EXPECT_GT(up[2], 0.0);
      const std::array<double, 3> cross = {right[1] * up[2] - right[2] * up[1], right[2] * up[0] - right[0] * up[2],
                                           right[0] * up[1] - right[1] * up[0]};
      const glm::vec3 eye = camera.eye_world_m();  // of a camera that looks at the origin from 1 m
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(cross[k], near[k], 1e-5);
        EXPECT_NEAR(near[k], eye[static_cast<int>(k)], 1e-6);
      }
    }
  }
}

TEST(Camera, TurnsToAnotherViewByTheShorterWay) {
  constexpr float kDegree = std::numbers::pi_v<float> / 180.0f;
  const Camera from{{0.0f, 0.0f, 0.0f}, 170.0f * kDegree, 0.2f, 1.0f},
      to{{0.2f, 0.4f, 0.6f}, -150.0f * kDegree, 0.6f, 3.0f};
  const Camera quarter = between(from, to, 0.25f), back = between(to, from, 0.25f);
  EXPECT_NEAR(std::abs(quarter.azimuth_rad), std::numbers::pi_v<float>, 1e-5f) << "10 of 40 degrees";
  EXPECT_NEAR(back.azimuth_rad, -160.0f * kDegree, 1e-5f);
  EXPECT_NEAR(quarter.elevation_rad, 0.3f, 1e-6f);
  EXPECT_NEAR(quarter.distance_m, 1.5f, 1e-6f);
  EXPECT_NEAR(quarter.target_world_m.z, 0.15f, 1e-6f);
  for (int i = 1; i < 50; ++i) {
    const float odd = 0.0123f * static_cast<float>(i);
    const Camera end{{odd, 3.0f * odd, -odd}, 2.0f * odd, odd, 0.7f + odd};
    EXPECT_EQ(between(from, end, 1.0f), end) << "to the bit, or undo would see a change";
  }
  EXPECT_NEAR(between(from, to, 0.0f).azimuth_rad, from.azimuth_rad, 1e-6f);
}

TEST(ColourMap, RisesInBrightnessFromEndToEnd) {
  for (glm::vec3 (*map)(double) : {cividis, red_yellow}) {
    const auto brightness = [map](double level) {
      const glm::vec3 c = map(level);
      return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
    };
    for (double level = 0.05; level <= 1.0; level += 0.05) EXPECT_GT(brightness(level), brightness(level - 0.05));
    EXPECT_EQ(map(-1.0), map(0.0));
  }
}

/// L* of CIELAB of an sRGB colour (IEC 61966-2-1).
double lightness(const glm::vec3& srgb) {
  const auto linear = [](double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); };
  const double y = 0.2126 * linear(double(srgb.r)) + 0.7152 * linear(double(srgb.g)) + 0.0722 * linear(double(srgb.b));
  return 116.0 * std::cbrt(y) - 16.0;
}

TEST(ColourMap, FromRedToYellowLightnessRisesEvenly) {
  constexpr double kLowest = 38.5, kHighest = 91.4;
  for (int i = 0; i <= 9; ++i) {
    const double level = i / 9.0;
    EXPECT_NEAR(lightness(red_yellow(level)), kLowest + level * (kHighest - kLowest), 1.5) << level;
  }
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
