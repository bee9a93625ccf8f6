#include "view/window/pointer.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "view/hinge_window.h"
#include "view/look/limb_bounds.h"
#include "view/look/start_view.h"

namespace myotact::view {
namespace {

constexpr Area kSceneArea{100.0f, 60.0f, 900.0f, 600.0f};
constexpr float kSceneAspect = 1.5f;
constexpr double kRadius_m = 0.006;   // of the tool
constexpr double kPixel_m = 0.6e-3;   // about the width of one on the limb, where the mouse is told in whole pixels
constexpr double kNearSide_m = 0.01;  // y of the muscles' surface that the lateral view of a left limb sees
const glm::vec3 kOnFlexor{-0.03f, 0.01f, 0.03f};

/// The mouse over an antagonist hinge at rest, seen from its lateral side.
class PointerTest : public myotact::testing::HingeWindow {
 protected:
  PointerTest() : HingeWindow(kSceneAspect) {
    frame_.tools.resize(1);
    frame_.tools[0].radius_m = kRadius_m;
    controls_.hand_world_m = {-0.03, 0.15, 0.03};
  }
  void draw() {
    window_.picture([&] {
      PanelContext context = HingeWindow::context();
      controls_.hand_buttons = 0;
      pointer_.update(context, kSceneArea, {});
    });
  }
  ImVec2 pixel_of(const glm::vec3& p) const {
    const glm::vec4 clip = view_.camera.clip_from_world(kSceneAspect) * glm::vec4(p, 1.0f);
    return {kSceneArea.x + kSceneArea.width * (0.5f + 0.5f * clip.x / clip.w),
            kSceneArea.y + kSceneArea.height * (0.5f - 0.5f * clip.y / clip.w)};
  }
  void move_to(const ImVec2& at) {
    ImGui::GetIO().MousePos = at;
    draw();
  }
  void move_to(const glm::vec3& p) { move_to(pixel_of(p)); }
  void set_button(bool down, int button = 0) {
    ImGui::GetIO().MouseDown[button] = down;
    draw();
  }
  /// So that what follows is no double click.
  void wait(int pictures = 50) {
    for (int i = 0; i < pictures; ++i) draw();
  }
  void turn_wheel(float clicks) {
    ImGui::GetIO().MouseWheel = clicks;
    draw();
  }

  Pointer pointer_;
};

TEST_F(PointerTest, AClickSelectsAndADragDoesNot) {
  move_to(kOnFlexor);
  EXPECT_EQ(pointer_.hovered(), (Part{PartKind::Muscle, 0}));
  set_button(true);
  EXPECT_EQ(view_.selected_muscle, -1) << "not before it is let go";
  set_button(false);
  EXPECT_EQ(view_.selected_muscle, 0);
  wait();
  move_to({-0.1f, 0.008f, 0.0f});
  set_button(true);
  move_to(glm::vec3(0.1f, 0.008f, 0.0f));
  set_button(false);
  EXPECT_EQ(view_.selected_muscle, 0) << "a drag";
  wait();
  move_to(ImVec2(kSceneArea.x + 3.0f, kSceneArea.y + 3.0f));
  EXPECT_FALSE(pointer_.hovered());
  set_button(true);
  set_button(false);
  EXPECT_FALSE(selected_part(view_)) << "a click beside the limb";
}

TEST_F(PointerTest, WhatAPanelTakesIsNotTheScenes) {
  const ImVec2 at = pixel_of(kOnFlexor);
  const auto draw_under_panel = [&] {
    window_.picture([&] {
      ImGui::SetNextWindowPos(ImVec2(at.x - 100.0f, at.y - 100.0f));
      ImGui::SetNextWindowSize(ImVec2(200.0f, 200.0f));
      ImGui::Begin("over the limb");
      ImGui::End();
      PanelContext context = HingeWindow::context();
      pointer_.update(context, kSceneArea, {});
    });
  };
  ImGui::GetIO().MousePos = at;
  for (int i = 0; i < 2; ++i) draw_under_panel();  // from its second picture on a panel is there for the mouse
  for (const bool down : {true, false}) {
    ImGui::GetIO().MouseDown[0] = down;
    ImGui::GetIO().MouseWheel = 1.0f;
    draw_under_panel();
  }
  EXPECT_FALSE(pointer_.hovered());
  EXPECT_FALSE(selected_part(view_));
  EXPECT_EQ(view_, start_view(specimen_, kSceneAspect));
}

TEST_F(PointerTest, TheWheelComesNearerToThePlaceUnderThePointer) {
  view_.camera.orbit(0.5f, 0.3f);
  // What lies under a whole pixel in the plane of the camera's target.
  const ImVec2 before(673.0f, 250.0f);
  const Ray ray = ray_through(view_.camera, (before.x - kSceneArea.x) / kSceneArea.width,
                              (before.y - kSceneArea.y) / kSceneArea.height, kSceneAspect);
  const glm::vec3 place =
      ray.origin_m + view_.camera.distance_m / glm::dot(ray.direction, view_.camera.forward_world()) * ray.direction;
  const float distance_m = view_.camera.distance_m;
  move_to(before);
  turn_wheel(3.0f);
  EXPECT_NEAR(view_.camera.distance_m, 0.729f * distance_m, 1e-5f);  // 0.9 a click
  EXPECT_NEAR(pixel_of(place).x, before.x, 0.05f);
  EXPECT_NEAR(pixel_of(place).y, before.y, 0.05f);
  turn_wheel(-3.0f);
  EXPECT_NEAR(view_.camera.distance_m, distance_m, 1e-5f);
  for (int i = 0; i < 100; ++i) turn_wheel(5.0f);
  EXPECT_NEAR(pixel_of(place).x, before.x, 0.5f) << "as near as it gets";
}

/// A drag to the right turns as if it took the limb along: the eye goes the other way, so its azimuth falls.
TEST_F(PointerTest, ADragGoesOnToTheNextViewTheSameWayRoundForBothLimbs) {
  constexpr float kQuarter = std::numbers::pi_v<float> / 2.0f;
  for (const char* side : {"left", "right"}) {
    specimen_.side = side;
    const bool left = specimen_.side == "left";
    for (const char* from : {"lateral", "medial", "cranial", "caudal"}) {
      for (const float px : {200.0f, -200.0f}) {
        view_.camera = *standard_view(from, left, bounds_of(specimen_), kSceneAspect);
        asks_.standard_view = nullptr;
        move_to(ImVec2(500.0f, 300.0f));
        set_button(true);
        move_to(ImVec2(500.0f + px, 310.0f));
        EXPECT_EQ(asks_.standard_view, nullptr) << "while it is dragged";
        set_button(false);
        ASSERT_NE(asks_.standard_view, nullptr);
        const Camera next = *standard_view(asks_.standard_view, left, bounds_of(specimen_), kSceneAspect);
        const float turned = std::remainder(next.azimuth_rad - view_.camera.azimuth_rad, 4.0f * kQuarter);
        EXPECT_NEAR(turned, px > 0.0f ? -kQuarter : kQuarter, 1e-5f) << side << " " << from << " " << px;
        wait();
      }
    }
  }
}

TEST_F(PointerTest, TheToolHoversGoesInAsDeepAsAskedAndNoHandIsFasterThanAHand) {
  pointer_.set_mode(PointerMode::Touch);
  const auto follow = [&](const glm::vec3& p, int pictures) {
    for (int i = 0; i < pictures; ++i) {
      const auto before = controls_.hand_world_m;
      move_to(p);
      const auto& now = controls_.hand_world_m;
      const double way_m = std::hypot(now[0] - before[0], now[1] - before[1], now[2] - before[2]);
      ASSERT_LE(way_m, 0.02 * 0.35 + 1e-9) << "0.35 m/s, a picture in 0.02 s";
    }
  };
  follow(kOnFlexor, 100);
  EXPECT_TRUE(controls_.hand_moves);
  EXPECT_NEAR(controls_.hand_world_m[0], -0.03, kPixel_m);
  EXPECT_NEAR(controls_.hand_world_m[2], 0.03, kPixel_m);
  EXPECT_GT(controls_.hand_world_m[1], kNearSide_m + kRadius_m + 0.002) << "does not touch by accident";
  turn_wheel(4.0f);
  EXPECT_NEAR(pointer_.depth_m(), 0.003, 1e-9);
  ImGui::GetIO().MouseDown[0] = true;
  follow(kOnFlexor, 100);
  EXPECT_NEAR(controls_.hand_world_m[1], kNearSide_m + kRadius_m - pointer_.depth_m(), 1e-4);
  follow({-0.06f, 0.01f, 0.03f}, 50);  // slides
  EXPECT_NEAR(controls_.hand_world_m[0], -0.06, kPixel_m);
  EXPECT_NEAR(controls_.hand_world_m[1], kNearSide_m + kRadius_m - pointer_.depth_m(), 1e-4);
  for (int i = 0; i < 100; ++i) turn_wheel(3.0f);
  EXPECT_NEAR(pointer_.depth_m(), 0.006, 1e-9);
  for (int i = 0; i < 100; ++i) turn_wheel(-3.0f);
  EXPECT_GT(pointer_.depth_m(), 0.0);
  EXPECT_EQ(view_.camera, start_view(specimen_, kSceneAspect).camera) << "the wheel is the depth's";
}

/// Let go beside the limb, over it, or by going over to looking: the tool must not press on, unseen.
TEST_F(PointerTest, AToolThatIsLetGoLeavesTheTissue) {
  const ImVec2 beside(kSceneArea.x + 3.0f, kSceneArea.y + 3.0f);
  for (const bool looks : {false, true}) {
    pointer_.set_mode(PointerMode::Touch);
    move_to(kOnFlexor);
    ImGui::GetIO().MouseDown[0] = true;
    wait(150);
    ASSERT_LT(controls_.hand_world_m[1], kNearSide_m + kRadius_m);
    move_to(beside);
    wait(10);
    EXPECT_LT(controls_.hand_world_m[1], kNearSide_m + kRadius_m) << "held beside the limb it stays in";
    ImGui::GetIO().MouseDown[0] = false;
    if (looks) pointer_.set_mode(PointerMode::Look);
    wait(100);
    EXPECT_GT(controls_.hand_world_m[1], kNearSide_m + kRadius_m + 0.01) << looks;
    wait(50);
    EXPECT_EQ(controls_.hand_moves, !looks) << "out of the tissue it rests";
  }
}

TEST_F(PointerTest, WhatIsToBeKnownByTouchIsFeltWhereItIsNotSeen) {
  view_.muscles[0].hidden = true;
  pointer_.set_mode(PointerMode::Touch);
  move_to(kOnFlexor);
  EXPECT_FALSE(pointer_.hovered());
  view_.names_hidden = true;
  move_to(kOnFlexor);
  EXPECT_EQ(pointer_.hovered(), (Part{PartKind::Muscle, 0}));
  pointer_.set_mode(PointerMode::Look);
  move_to(kOnFlexor);
  EXPECT_FALSE(pointer_.hovered()) << "a look would give it away";
}

}  // namespace
}  // namespace myotact::view
