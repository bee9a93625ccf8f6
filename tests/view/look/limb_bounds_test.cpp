#include "view/look/limb_bounds.h"

#include <gtest/gtest.h>

#include "support/synthetic_specimen.h"
#include "view/look/picking.h"
#include "view/look/start_view.h"
#include "view/look/visibility.h"
#include "view/overlay/seen_parts.h"
#include "view/view_frame.h"

// Where the limb is, what of it is shown, and what of that a person can see.

namespace myotact::view {
namespace {

void expect_box(const ViewBox& box, const glm::vec3& lowest_m, const glm::vec3& highest_m) {
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(box.lowest_m[k], lowest_m[k], 1e-6f) << k;
    EXPECT_NEAR(box.highest_m[k], highest_m[k], 1e-6f) << k;
  }
}

/// Bones of 16 mm along x from -0.2 m to 0.2 m; bars of 20 mm from x = -0.09 m to 0.03 m, 30 mm above and below them.
class SeenLimbTest : public ::testing::Test {
 protected:
  std::vector<Part> parts_seen() const {
    std::vector<Part> parts;
    for (const SeenPart& seen : seen_parts(specimen_, frame_, view_, superficial_, 1.5f).parts)
      parts.push_back(seen.part);
    return parts;
  }
  void look_from(const char* side) { view_.camera = *standard_view(side, true, bounds_of(specimen_), 1.5f); }

  anatomy::Specimen specimen_ = myotact::testing::antagonist_hinge();
  messages::SceneFrame frame_ = myotact::testing::frame_at_rest(specimen_);
  ViewState view_ = start_view(specimen_, 1.5f);
  std::vector<bool> superficial_{true, false};
  const Part flexor_{PartKind::Muscle, 0}, extensor_{PartKind::Muscle, 1}, upper_{PartKind::Bone, 0},
      lower_{PartKind::Bone, 1};
};

TEST_F(SeenLimbTest, TheBoxIsThatOfAllParts) {
  expect_box(bounds_of(specimen_), {-0.2f, -0.01f, -0.04f}, {0.2f, 0.01f, 0.04f});
  expect_box(bounds_of(specimen_, frame_, flexor_), {-0.09f, -0.01f, 0.02f}, {0.03f, 0.01f, 0.04f});
  expect_box(bounds_of(specimen_, frame_, lower_), {0.005f, -0.008f, -0.008f}, {0.2f, 0.008f, 0.008f});
}

TEST_F(SeenLimbTest, TheBoxFollowsSkinsAndBones) {
  for (auto& p : frame_.skins_world_m[0]) p[2] += 1.0f;
  frame_.body_poses[1] = {0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0};  // a quarter turn about z: x becomes y
  expect_box(bounds_of(specimen_, frame_, flexor_), {-0.09f, -0.01f, 1.02f}, {0.03f, 0.01f, 1.04f});
  expect_box(bounds_of(specimen_, frame_, lower_), {-0.008f, 0.005f, -0.008f}, {0.008f, 0.2f, 0.008f});
  expect_box(bounds_of(specimen_, frame_), {-0.2f, -0.01f, -0.04f}, {0.03f, 0.2f, 1.04f});
}

TEST_F(SeenLimbTest, WhatAFrameDoesNotTellStandsAsInTheFile) {
  frame_.skins_world_m.resize(1);
  for (auto& p : frame_.skins_world_m[0]) p[1] += 0.5f;
  frame_.body_poses.clear();
  expect_box(bounds_of(specimen_, frame_), {-0.2f, -0.01f, -0.04f}, {0.2f, 0.51f, 0.04f});
  expect_box(bounds_of(specimen_, frame_, extensor_), {-0.09f, -0.01f, -0.04f}, {0.03f, 0.01f, -0.02f});
}

TEST_F(SeenLimbTest, TheFirstLookIsFromTheLateralSideOfEachLimb) {
  for (const char* side : {"left", "right"}) {
    specimen_.side = side;
    const ViewState view = start_view(specimen_, 1.5f);
    EXPECT_EQ(view.camera.eye_world_m().y > 0.0f, specimen_.side == "left") << side;
    EXPECT_EQ(view.muscles, std::vector<PartLook>(2));
    EXPECT_EQ(view.bones, std::vector<PartLook>(2));
    EXPECT_FALSE(selected_part(view));
  }
}

TEST_F(SeenLimbTest, ASectionKeepsOneSideOfItsPlace) {
  const ViewBox box{{-1.0f, 0.0f, 2.0f}, {3.0f, 0.5f, 4.0f}};
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 place = box.lowest_m;
    place[axis] += 0.25f * (box.highest_m[axis] - box.lowest_m[axis]);
    for (const bool flipped : {false, true}) {
      const glm::vec4 kept = kept_half_space({true, flipped, axis, 0.25f}, box);
      glm::vec3 below = place, above = place;
      below[axis] -= 0.01f;
      above[axis] += 0.01f;
      EXPECT_EQ(is_kept(kept, below), !flipped) << axis;
      EXPECT_EQ(is_kept(kept, above), flipped) << axis;
    }
  }
  const glm::vec4 off = kept_half_space({false, true, 2, 0.9f}, box);
  EXPECT_TRUE(is_kept(off, box.lowest_m) && is_kept(off, box.highest_m));
}

TEST_F(SeenLimbTest, AFadedPartOfAFaintLayerIsFainterThanBoth) {
  view_.layers = {0.5f, 0.25f, 0.75f};
  EXPECT_FLOAT_EQ(opacity_of(view_, superficial_, flexor_), 0.5f);
  EXPECT_FLOAT_EQ(opacity_of(view_, superficial_, extensor_), 0.25f);
  EXPECT_FLOAT_EQ(opacity_of(view_, superficial_, upper_), 0.75f);
  view_.muscles[0].faded = view_.bones[0].faded = true;
  EXPECT_FLOAT_EQ(opacity_of(view_, superficial_, flexor_), 0.28f * 0.5f);
  EXPECT_FLOAT_EQ(opacity_of(view_, superficial_, upper_), 0.28f * 0.75f);
  view_.muscles[0].hidden = true;
  EXPECT_EQ(opacity_of(view_, superficial_, flexor_), 0.0f);
  EXPECT_FLOAT_EQ(opacity_of(view_, {}, extensor_), 0.5f) << "of what is not known to be deep";
  EXPECT_FLOAT_EQ(opacity_of(ViewState{}, {}, extensor_), 1.0f) << "a view that has no looks yet";
}

TEST_F(SeenLimbTest, EveryNameStandsOnAPlaceWhereItsPartIsHit) {
  for (const char* side : {"lateral", "medial", "cranial", "caudal", "dorsal", "palmar"}) {
    look_from(side);
    const SeenLimb limb = seen_parts(specimen_, frame_, view_, superficial_, 1.5f);
    EXPECT_FALSE(limb.parts.empty());
    float shares = 0.0f;
    for (const SeenPart& seen : limb.parts) {
      const Ray ray = ray_through(view_.camera, seen.place.x, seen.place.y, 1.5f);
      const auto hit = pick(specimen_, frame_, view_, superficial_, ray);
      ASSERT_TRUE(hit) << side;
      EXPECT_EQ(hit->part, seen.part) << side;
      EXPECT_GE(seen.place.x, limb.left);
      EXPECT_LE(seen.place.x, limb.right);
      shares += seen.share;
    }
    EXPECT_LT(shares, 1.0f);
  }
}

TEST_F(SeenLimbTest, WhatIsBehindAnotherOrCutAwayHasNoName) {
  look_from("dorsal");
  EXPECT_EQ(parts_seen(), (std::vector<Part>{flexor_, upper_, lower_})) << "the extensor is below the flexor";
  view_.muscles[0].faded = true;
  view_.layers.bones = 0.0f;
  EXPECT_EQ(parts_seen(), std::vector<Part>{extensor_});
  view_ = start_view(specimen_, 1.5f);
  view_.section = {true, false, 2, 0.6f};  // what lies above 8 mm is gone
  EXPECT_EQ(parts_seen(), (std::vector<Part>{extensor_, upper_, lower_}));
  view_.section = {true, true, 0, 0.9f};  // what lies caudal of 160 mm
  EXPECT_EQ(parts_seen(), std::vector<Part>{lower_});
  view_.section.on = false;
  view_.camera.target_world_m.x += 50.0f;
  EXPECT_TRUE(parts_seen().empty()) << "a look past the limb";
}

}  // namespace
}  // namespace myotact::view
