#include "view/key_bindings.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace myotact::view {

const std::array<KeyBinding, 16>& key_bindings() {
  static constexpr std::array<KeyBinding, 16> kBindings = {{
      {GLFW_KEY_F1, KeyAction::Help, "F1", "show or hide this help"},
      {GLFW_KEY_SPACE, KeyAction::PauseOrPlay, "Space", "pause or play"},
      {GLFW_KEY_RIGHT, KeyAction::Step, "Right", "one step while paused"},
      {GLFW_KEY_BACKSPACE, KeyAction::Reset, "Backspace", "back to the start"},
      {GLFW_KEY_1, KeyAction::Lateral, "1", "lateral view"},
      {GLFW_KEY_2, KeyAction::Medial, "2", "medial view"},
      {GLFW_KEY_3, KeyAction::Cranial, "3", "cranial view"},
      {GLFW_KEY_4, KeyAction::Caudal, "4", "caudal view"},
      {GLFW_KEY_5, KeyAction::Dorsal, "5", "dorsal view"},
      {GLFW_KEY_6, KeyAction::Palmar, "6", "palmar view"},
      {GLFW_KEY_F, KeyAction::FrameAll, "F", "frame the whole limb"},
      {GLFW_KEY_G, KeyAction::GrabLine, "G (hold)", "take the nearest muscle line"},
      {GLFW_KEY_B, KeyAction::GrabBone, "B (hold)", "take the nearest bone, the paw too"},
      {GLFW_KEY_ESCAPE, KeyAction::StopForces, "Esc", "emergency stop: all forces off, until Enter"},
      {GLFW_KEY_ENTER, KeyAction::EnableForces, "Enter", "forces on again after a stop"},
      {GLFW_KEY_F12, KeyAction::Screenshot, "F12", "screenshot"},
  }};
  return kBindings;
}

}  // namespace myotact::view
