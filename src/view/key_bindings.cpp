#include "view/key_bindings.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace myotact::view {

namespace {

std::string key_name(int key) {
  constexpr std::array kNames = {std::pair{GLFW_KEY_SPACE, "Space"}, std::pair{GLFW_KEY_RIGHT, "Right"},
                                 std::pair{GLFW_KEY_LEFT, "Left"},   std::pair{GLFW_KEY_BACKSPACE, "Backspace"},
                                 std::pair{GLFW_KEY_HOME, "Home"},   std::pair{GLFW_KEY_ESCAPE, "Esc"},
                                 std::pair{GLFW_KEY_ENTER, "Enter"}};
  for (const auto& [code, name] : kNames) {
    if (code == key) return name;
  }
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F25) return fmt::format("F{}", key - GLFW_KEY_F1 + 1);
  return {static_cast<char>(key)};  // letters and digits are their own codes
}

}  // namespace

bool is_held(KeyAction action) {
  return action == KeyAction::GrabLine || action == KeyAction::GrabBone;
}

std::string name_of(const KeyBinding& binding) {
  std::string name;
  if ((binding.mods & GLFW_MOD_CONTROL) != 0) name += "Ctrl+";
  if ((binding.mods & GLFW_MOD_SHIFT) != 0) name += "Shift+";
  if ((binding.mods & GLFW_MOD_ALT) != 0) name += "Alt+";
  name += key_name(binding.key);
  if (is_held(binding.action)) name += " (hold)";
  return name;
}

const std::vector<KeyBinding>& key_bindings() {
  constexpr int kCtrl = GLFW_MOD_CONTROL, kShift = GLFW_MOD_SHIFT;
  static const std::vector<KeyBinding> kBindings = {
      {GLFW_KEY_F1, 0, KeyAction::Help, "keys.help"},
      {GLFW_KEY_ESCAPE, 0, KeyAction::StopForces, "keys.stop_forces"},
      {GLFW_KEY_ENTER, 0, KeyAction::EnableForces, "keys.enable_forces"},
      {GLFW_KEY_SPACE, 0, KeyAction::PauseOrPlay, "keys.pause"},
      {GLFW_KEY_RIGHT, 0, KeyAction::Step, "keys.step"},
      {GLFW_KEY_LEFT, 0, KeyAction::StepBack, "keys.step_back"},
      {GLFW_KEY_BACKSPACE, 0, KeyAction::Reset, "keys.reset"},
      {GLFW_KEY_V, 0, KeyAction::Look, "keys.look"},
      {GLFW_KEY_T, 0, KeyAction::Touch, "keys.touch"},
      {GLFW_KEY_P, 0, KeyAction::Pull, "keys.pull"},
      {GLFW_KEY_G, 0, KeyAction::GrabLine, "keys.grab_line"},
      {GLFW_KEY_B, 0, KeyAction::GrabBone, "keys.grab_bone"},
      {GLFW_KEY_1, 0, KeyAction::Lateral, "keys.lateral"},
      {GLFW_KEY_2, 0, KeyAction::Medial, "keys.medial"},
      {GLFW_KEY_3, 0, KeyAction::Cranial, "keys.cranial"},
      {GLFW_KEY_4, 0, KeyAction::Caudal, "keys.caudal"},
      {GLFW_KEY_5, 0, KeyAction::Dorsal, "keys.dorsal"},
      {GLFW_KEY_6, 0, KeyAction::Palmar, "keys.palmar"},
      {GLFW_KEY_F, 0, KeyAction::FrameSelection, "keys.frame_selection"},
      {GLFW_KEY_HOME, 0, KeyAction::FrameAll, "keys.frame_all"},
      {GLFW_KEY_F, kCtrl, KeyAction::Search, "keys.search"},
      {GLFW_KEY_H, 0, KeyAction::Hide, "keys.hide"},
      {GLFW_KEY_I, 0, KeyAction::Isolate, "keys.isolate"},
      {GLFW_KEY_H, kShift, KeyAction::ShowAll, "keys.show_all"},
      {GLFW_KEY_L, 0, KeyAction::Labels, "keys.labels"},
      {GLFW_KEY_Z, kCtrl, KeyAction::Undo, "keys.undo"},
      {GLFW_KEY_Y, kCtrl, KeyAction::Redo, "keys.redo"},
      {GLFW_KEY_P, kCtrl, KeyAction::Screenshot, "keys.screenshot"},
      {GLFW_KEY_R, kCtrl, KeyAction::Record, "keys.record"},
      {GLFW_KEY_P, kCtrl | kShift, KeyAction::SceneScreenshot, "keys.scene_screenshot"},
      {GLFW_KEY_S, kCtrl, KeyAction::SaveWork, "keys.save_work"},
      {GLFW_KEY_O, kCtrl, KeyAction::OpenWork, "keys.open_work"},
      {GLFW_KEY_F11, 0, KeyAction::FullScreen, "keys.full_screen"},
  };
  return kBindings;
}

const KeyBinding* binding_of(int key, int mods) {
  const auto& all = key_bindings();
  const auto found = std::find_if(all.begin(), all.end(), [&](const KeyBinding& known) {
    return known.key == key && (known.mods == mods || known.action == KeyAction::StopForces);
  });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace myotact::view
