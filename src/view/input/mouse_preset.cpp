#include "view/input/mouse_preset.h"

#include <array>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace myotact::view {

namespace {

constexpr int kLeft = GLFW_MOUSE_BUTTON_LEFT, kRight = GLFW_MOUSE_BUTTON_RIGHT, kMiddle = GLFW_MOUSE_BUTTON_MIDDLE;
constexpr int kShift = GLFW_MOD_SHIFT, kCtrl = GLFW_MOD_CONTROL, kAlt = GLFW_MOD_ALT;
constexpr const char *kRotates = "mouse.turn", *kShifts = "mouse.shift", *kNearer = "mouse.nearer";

constexpr std::array kThreeButton = {MouseRow{kLeft, 0, CameraDrag::Rotate, "mouse.left", kRotates},
                                     MouseRow{kRight, 0, CameraDrag::Shift, "mouse.right", kShifts},
                                     MouseRow{kLeft, kShift, CameraDrag::Shift, "mouse.shift_left", kShifts}};
constexpr std::array kTrackpad = {MouseRow{kLeft, 0, CameraDrag::Rotate, "mouse.left", kRotates},
                                  MouseRow{kLeft, kAlt, CameraDrag::Rotate, "mouse.alt_left", "mouse.turn_always"},
                                  MouseRow{kLeft, kShift, CameraDrag::Shift, "mouse.shift_left", kShifts}};
constexpr std::array kBlender = {MouseRow{kMiddle, 0, CameraDrag::Rotate, "mouse.middle", kRotates},
                                 MouseRow{kMiddle, kShift, CameraDrag::Shift, "mouse.shift_middle", kShifts},
                                 MouseRow{kMiddle, kCtrl, CameraDrag::Nearer, "mouse.ctrl_middle", kNearer}};

}  // namespace

std::span<const MouseRow> mouse_rows(MousePreset preset) {
  switch (preset) {
    case MousePreset::Trackpad:
      return kTrackpad;
    case MousePreset::Blender:
      return kBlender;
    default:
      return kThreeButton;
  }
}

std::optional<CameraDrag> camera_drag(MousePreset preset, int button, int mods, bool looking) {
  for (const MouseRow& row : mouse_rows(preset)) {
    if (row.button != button || row.mods != mods) continue;
    if (button == kLeft && mods == 0 && !looking) continue;
    return row.drag;
  }
  return std::nullopt;
}

const char* number_pad_view(int key, int mods) {
  struct Row {
    int key;
    const char *view, *opposite;
  };
  constexpr std::array kRows = {Row{GLFW_KEY_KP_1, "cranial", "caudal"}, Row{GLFW_KEY_KP_3, "lateral", "medial"},
                                Row{GLFW_KEY_KP_7, "dorsal", "palmar"}};
  for (const Row& row : kRows) {
    if (row.key == key && (mods == 0 || mods == kCtrl)) return mods == 0 ? row.view : row.opposite;
  }
  return nullptr;
}

}  // namespace myotact::view
