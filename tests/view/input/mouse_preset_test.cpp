#include "view/input/mouse_preset.h"

#include <algorithm>
#include <set>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "view/look/camera.h"
#include "view/ui/text.h"

namespace myotact::view {
namespace {

constexpr int kLeft = GLFW_MOUSE_BUTTON_LEFT, kRight = GLFW_MOUSE_BUTTON_RIGHT, kMiddle = GLFW_MOUSE_BUTTON_MIDDLE;

class Presets : public ::testing::TestWithParam<MousePreset> {};

TEST_P(Presets, NoDragDoesTwoThingsAndEachHasItsTexts) {
  std::set<std::pair<int, int>> drags;
  bool turns = false, shifts = false;
  for (const MouseRow& row : mouse_rows(GetParam())) {
    EXPECT_TRUE(drags.emplace(row.button, row.mods).second);
    EXPECT_TRUE(ui::has_text(row.how)) << row.how;
    EXPECT_TRUE(ui::has_text(row.what)) << row.what;
    turns = turns || row.drag == CameraDrag::Rotate;
    shifts = shifts || row.drag == CameraDrag::Shift;
  }
  EXPECT_TRUE(turns);
  EXPECT_TRUE(shifts);
}

TEST_P(Presets, LeaveTheLeftButtonToTheHandThatTouches) {
  EXPECT_EQ(camera_drag(GetParam(), kLeft, 0, false), std::nullopt);
  EXPECT_EQ(camera_drag(GetParam(), kLeft, GLFW_MOD_CONTROL, true), std::nullopt);  // the hand, freely
}

INSTANTIATE_TEST_SUITE_P(All, Presets,
                         ::testing::Values(MousePreset::ThreeButton, MousePreset::Trackpad, MousePreset::Blender));

TEST(MousePresets, TheTrackpadNeedsTheLeftButtonAlone) {
  for (const MouseRow& row : mouse_rows(MousePreset::Trackpad)) EXPECT_EQ(row.button, kLeft);
  EXPECT_EQ(camera_drag(MousePreset::Trackpad, kLeft, GLFW_MOD_ALT, false), CameraDrag::Rotate);
  EXPECT_EQ(camera_drag(MousePreset::Trackpad, kLeft, GLFW_MOD_SHIFT, false), CameraDrag::Shift);
}

// Blender's manual, "3D Viewport > Navigation": middle drag orbits, with Shift pans, with Ctrl zooms; on the number pad
// 1 is the front, 3 the right side, 7 the top, with Ctrl their opposites.
TEST(MousePresets, BlenderIsAsInItsManual) {
  const MousePreset blender = MousePreset::Blender;
  EXPECT_EQ(camera_drag(blender, kMiddle, 0, true), CameraDrag::Rotate);
  EXPECT_EQ(camera_drag(blender, kMiddle, GLFW_MOD_SHIFT, true), CameraDrag::Shift);
  EXPECT_EQ(camera_drag(blender, kMiddle, GLFW_MOD_CONTROL, false), CameraDrag::Nearer);
  EXPECT_EQ(camera_drag(blender, kLeft, 0, true), std::nullopt);
  EXPECT_EQ(camera_drag(blender, kRight, 0, true), std::nullopt);
  EXPECT_STREQ(number_pad_view(GLFW_KEY_KP_1, 0), "cranial");
  EXPECT_STREQ(number_pad_view(GLFW_KEY_KP_7, GLFW_MOD_CONTROL), "palmar");
  EXPECT_EQ(number_pad_view(GLFW_KEY_1, 0), nullptr);
  EXPECT_EQ(number_pad_view(GLFW_KEY_KP_1, GLFW_MOD_ALT), nullptr);
  for (const int key : {GLFW_KEY_KP_1, GLFW_KEY_KP_3, GLFW_KEY_KP_7}) {
    for (const int mods : {0, GLFW_MOD_CONTROL}) {
      EXPECT_TRUE(standard_view(number_pad_view(key, mods), true, ViewBox{}, 1.0f)) << key << " " << mods;
    }
  }
}

}  // namespace
}  // namespace myotact::view
