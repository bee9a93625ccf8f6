#include "view/input/key_bindings.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "view/ui/text.h"

namespace myotact::view {

namespace {

std::string bare_name(int key) {
  constexpr std::array kNames = {std::pair{GLFW_KEY_SPACE, "Space"},      std::pair{GLFW_KEY_RIGHT, "Right"},
                                 std::pair{GLFW_KEY_LEFT, "Left"},        std::pair{GLFW_KEY_UP, "Up"},
                                 std::pair{GLFW_KEY_DOWN, "Down"},        std::pair{GLFW_KEY_BACKSPACE, "Backspace"},
                                 std::pair{GLFW_KEY_HOME, "Home"},        std::pair{GLFW_KEY_END, "End"},
                                 std::pair{GLFW_KEY_PAGE_UP, "Page Up"},  std::pair{GLFW_KEY_PAGE_DOWN, "Page Down"},
                                 std::pair{GLFW_KEY_INSERT, "Insert"},    std::pair{GLFW_KEY_DELETE, "Delete"},
                                 std::pair{GLFW_KEY_ESCAPE, "Esc"},       std::pair{GLFW_KEY_ENTER, "Enter"},
                                 std::pair{GLFW_KEY_KP_ADD, "Num +"},     std::pair{GLFW_KEY_KP_SUBTRACT, "Num -"},
                                 std::pair{GLFW_KEY_KP_MULTIPLY, "Num *"}};
  for (const auto& [code, name] : kNames) {
    if (code == key) return name;
  }
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F25) return fmt::format("F{}", key - GLFW_KEY_F1 + 1);
  if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) return fmt::format("Num {}", key - GLFW_KEY_KP_0);
  constexpr std::string_view kSigns = "',-./0123456789;=[\\]`";  // that GLFW has keys of, by these codes
  const bool letter = key >= GLFW_KEY_A && key <= GLFW_KEY_Z;
  if (!letter && (key < GLFW_KEY_APOSTROPHE || key > GLFW_KEY_GRAVE_ACCENT ||
                  kSigns.find(static_cast<char>(key)) == std::string_view::npos)) {
    return "";
  }
  return {static_cast<char>(key)};
}

}  // namespace

bool is_held(KeyAction action) {
  return action == KeyAction::GrabLine || action == KeyAction::GrabBone || action == KeyAction::Clutch;
}

std::string key_name(int key, int mods) {
  const std::string bare = bare_name(key);
  if (bare.empty()) return "";
  std::string name;
  if ((mods & GLFW_MOD_CONTROL) != 0) name += "Ctrl+";
  if ((mods & GLFW_MOD_SHIFT) != 0) name += "Shift+";
  if ((mods & GLFW_MOD_ALT) != 0) name += "Alt+";
  return name + bare;
}

std::string name_of(const KeyBinding& binding) {
  return fmt::format("{}{}", key_name(binding.key, binding.mods), is_held(binding.action) ? " (hold)" : "");
}

std::string shown_key(int key, int mods) {
  const auto shown = [](const std::string& name) {
    const std::string text = "key." + name;
    return ui::has_text(text) ? std::string(ui::tr(text)) : name;
  };
  const std::string bare = bare_name(key);
  if (bare.empty()) return "";
  std::string name;
  if ((mods & GLFW_MOD_CONTROL) != 0) name += shown("Ctrl") + "+";
  if ((mods & GLFW_MOD_SHIFT) != 0) name += shown("Shift") + "+";
  if ((mods & GLFW_MOD_ALT) != 0) name += shown("Alt") + "+";
  return name + shown(bare);
}

std::string shown_name(const KeyBinding& binding) {
  const std::string key = shown_key(binding.key, binding.mods);
  return is_held(binding.action) ? ui::tr("key.hold", key) : key;
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
      {GLFW_KEY_C, 0, KeyAction::Clutch, "keys.clutch"},
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
      {GLFW_KEY_R, kCtrl | kShift, KeyAction::Film, "keys.film"},
      {GLFW_KEY_P, kCtrl | kShift, KeyAction::SceneScreenshot, "keys.scene_screenshot"},
      {GLFW_KEY_S, kCtrl, KeyAction::SaveWork, "keys.save_work"},
      {GLFW_KEY_O, kCtrl, KeyAction::OpenWork, "keys.open_work"},
      {GLFW_KEY_MINUS, 0, KeyAction::LessCoContraction, "keys.less_co_contraction"},
      {GLFW_KEY_EQUAL, 0, KeyAction::MoreCoContraction, "keys.more_co_contraction"},
      {GLFW_KEY_1, kCtrl, KeyAction::TaskFeel, "keys.task_feel"},
      {GLFW_KEY_2, kCtrl, KeyAction::TaskSee, "keys.task_see"},
      {GLFW_KEY_3, kCtrl, KeyAction::TaskDemonstrate, "keys.task_demonstrate"},
      {GLFW_KEY_4, kCtrl, KeyAction::TaskLearn, "keys.task_learn"},
      {GLFW_KEY_5, kCtrl, KeyAction::TaskPlots, "keys.task_plots"},
      {GLFW_KEY_6, kCtrl, KeyAction::TaskSettings, "keys.task_settings"},
      {GLFW_KEY_F2, 0, KeyAction::FoldFind, "keys.fold_find"},
      {GLFW_KEY_F3, 0, KeyAction::FoldTasks, "keys.fold_tasks"},
      {GLFW_KEY_F4, 0, KeyAction::OtherState, "keys.other_state"},
      {GLFW_KEY_F6, 0, KeyAction::NextArea, "keys.next_area"},
      {GLFW_KEY_F6, kShift, KeyAction::PreviousArea, "keys.previous_area"},
      {GLFW_KEY_F9, 0, KeyAction::BigType, "keys.big_type"},
      {GLFW_KEY_F11, 0, KeyAction::FullScreen, "keys.full_screen"},
  };
  return kBindings;
}

const KeyBinding* binding_of(const std::vector<KeyBinding>& bindings, int key, int mods) {
  const auto found = std::find_if(bindings.begin(), bindings.end(), [&](const KeyBinding& known) {
    return known.key == key && (known.mods == mods || known.action == KeyAction::StopForces);
  });
  return found == bindings.end() ? nullptr : &*found;
}

}  // namespace myotact::view
