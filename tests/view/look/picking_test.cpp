#include "view/look/picking.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "support/synthetic_specimen.h"
#include "view/look/limb_bounds.h"
#include "view/look/posing.h"
#include "view/look/start_view.h"
#include "view/look/visibility.h"
#include "view/view_frame.h"

namespace myotact::view {
namespace {

class Picking : public ::testing::Test {
 protected:
  std::optional<PickHit> from_the_left(float x_m, float z_m) {
    return pick(specimen_, frame_, view_, {}, {{x_m, 1.0f, z_m}, {0.0f, -1.0f, 0.0f}});
  }

  anatomy::Specimen specimen_ = myotact::testing::antagonist_hinge();
  messages::SceneFrame frame_ = myotact::testing::frame_at_rest(specimen_);
  ViewState view_ = start_view(specimen_, 1.0f);
};

TEST_F(Picking, TheNearestPartIsHitWhereTheRayMeetsIt) {
  const auto flexor = from_the_left(-0.03f, 0.03f);  // a bar of 20 mm round this line
  ASSERT_TRUE(flexor);
  EXPECT_EQ(flexor->part, (Part{PartKind::Muscle, 0}));
  EXPECT_NEAR(flexor->point_world_m.y, 0.01f, 1e-6f);
  EXPECT_NEAR(flexor->distance_m, 0.99f, 1e-6f);
  EXPECT_EQ(from_the_left(-0.03f, -0.03f)->part, (Part{PartKind::Muscle, 1}));
  EXPECT_EQ(from_the_left(-0.05f, 0.0f)->part.kind, PartKind::Bone);
  EXPECT_FALSE(from_the_left(-0.03f, 0.3f));
}

TEST_F(Picking, WhatIsHiddenFadedOrCutAwayIsPassed) {
  const Ray down{{-0.03f, 0.0f, 1.0f}, {0.0f, 0.0f, -1.0f}};  // flexor, bone, extensor
  const auto first = [&] { return pick(specimen_, frame_, view_, {}, down)->part; };
  EXPECT_EQ(first(), (Part{PartKind::Muscle, 0}));
  view_.muscles[0].faded = true;
  EXPECT_EQ(first().kind, PartKind::Bone);
  view_.muscles[0] = {.hidden = true};
  EXPECT_EQ(first().kind, PartKind::Bone);
  view_.layers.bones = 0.2f;
  EXPECT_EQ(first(), (Part{PartKind::Muscle, 1}));
  view_ = start_view(specimen_, 1.0f);
  view_.section = {.on = true, .flipped = false, .axis = 2, .share = 0.0f};
  EXPECT_FALSE(pick(specimen_, frame_, view_, {}, down));
  view_.section.flipped = true;
  EXPECT_EQ(first(), (Part{PartKind::Muscle, 0}));
}

TEST_F(Picking, LayersTakeTheMusclesThatBelongToThem) {
  const std::vector<bool> superficial{true, false};
  view_.layers.deep = 0.0f;
  EXPECT_EQ(opacity_of(view_, superficial, {PartKind::Muscle, 0}), 1.0f);
  EXPECT_EQ(opacity_of(view_, superficial, {PartKind::Muscle, 1}), 0.0f);
  EXPECT_EQ(opacity_of(view_, superficial, {PartKind::Bone, 0}), 1.0f);
}

TEST_F(Picking, BonesAreHitWhereTheyStandNow) {
  // The lower body a metre higher: its bone is there, and no longer where it was.
  ASSERT_TRUE(from_the_left(0.1f, 0.0f));
  const Part lower = from_the_left(0.1f, 0.0f)->part;
  const auto body = static_cast<std::size_t>(specimen_.bones[static_cast<std::size_t>(lower.index)].body);
  frame_.body_poses[body] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1.0};
  EXPECT_FALSE(from_the_left(0.1f, 0.0f));
  ASSERT_TRUE(from_the_left(0.1f, 1.0f));
  EXPECT_EQ(from_the_left(0.1f, 1.0f)->part, lower);
  EXPECT_GT(bounds_of(specimen_, frame_).highest_m.z, 0.99f);
  EXPECT_GT(bounds_of(specimen_, frame_, lower).lowest_m.z, 0.9f);
}

TEST_F(Picking, ARayThroughAPixelMeetsWhatIsProjectedThere) {
  Camera camera = *standard_view("lateral", true, bounds_of(specimen_), 1.6f);
  camera.orbit(0.4f, 0.3f);
  const glm::mat4 clip_from_world = camera.clip_from_world(1.6f);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-0.1f, 0.1f);
  for (int i = 0; i < 50; ++i) {
    const glm::vec3 p(place(random), place(random), place(random));
    const glm::vec4 clip = clip_from_world * glm::vec4(p, 1.0f);
    const Ray ray = ray_through(camera, 0.5f + 0.5f * clip.x / clip.w, 0.5f - 0.5f * clip.y / clip.w, 1.6f);
    EXPECT_LT(glm::length(glm::cross(ray.direction, p - ray.origin_m)), 1e-5f);
  }
}

TEST(Camera, FramingAPartKeepsTheDirectionAndHoldsTheWholePart) {
  Camera camera;
  camera.orbit(1.1f, -0.4f);
  const ViewBox part{{0.1f, 0.02f, 0.3f}, {0.15f, 0.05f, 0.42f}};
  const Camera nearer = framed(camera, part, 1.3f);
  EXPECT_EQ(nearer.forward_world(), camera.forward_world());
  float widest = 0.0f;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec4 at((corner & 1) != 0 ? 0.1f : 0.15f, (corner & 2) != 0 ? 0.02f : 0.05f,
                       (corner & 4) != 0 ? 0.3f : 0.42f, 1.0f);
    const glm::vec4 clip = nearer.clip_from_world(1.3f) * at;
    widest = std::max({widest, std::abs(clip.x / clip.w), std::abs(clip.y / clip.w)});
  }
  EXPECT_LT(widest, 1.0f);
  EXPECT_GT(widest, 0.85f);
}

}  // namespace
}  // namespace myotact::view
