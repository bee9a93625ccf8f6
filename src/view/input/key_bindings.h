#pragma once

#include <string>
#include <vector>

namespace myotact::view {

/// What a key does. One table makes the handlers, the help and the list in docs/window.md, so that they cannot
/// disagree.
enum class KeyAction {
  Help,
  PauseOrPlay,
  Step,
  StepBack,
  Reset,
  Look,
  Touch,
  Pull,
  Lateral,
  Medial,
  Cranial,
  Caudal,
  Dorsal,
  Palmar,
  FrameSelection,
  FrameAll,
  Search,
  Hide,
  Isolate,
  ShowAll,
  Labels,
  Undo,
  Redo,
  GrabLine,
  GrabBone,
  Clutch,
  StopForces,
  EnableForces,
  Screenshot,
  Record,
  SceneScreenshot,
  Film,
  FullScreen,
  SaveWork,
  OpenWork,
  NextArea,
  PreviousArea,
  TaskFeel,
  TaskSee,
  TaskDemonstrate,
  TaskLearn,
  TaskPlots,
  TaskSettings,
  LessCoContraction,
  MoreCoContraction,
  BigType,
  FoldFind,
  FoldTasks,
  OtherState
};

struct KeyBinding {
  int key;   // GLFW_KEY_*
  int mods;  // GLFW_MOD_*, of Shift, Ctrl and Alt
  KeyAction action;
  const char* what;  // key of its text
};

/// All bindings as they are at first, in the order of the help.
const std::vector<KeyBinding>& key_bindings();

/// What a key does with these GLFW_MOD_* held, of `bindings`; null: nothing. The stop of the forces is the same with
/// any of them held: with Ctrl the mouse moves the hand, and that is when it is needed.
const KeyBinding* binding_of(const std::vector<KeyBinding>& bindings, int key, int mods);

/// "Ctrl+Z", "Backspace", "Num 7"; empty: no key that can be bound.
std::string key_name(int key, int mods);

/// As a person calls it: its key_name(), with " (hold)" where that is how it works.
std::string name_of(const KeyBinding& binding);

/// key_name() and name_of() in the language of the window: "Strg+Z". Settings and documents have the English ones.
std::string shown_key(int key, int mods);
std::string shown_name(const KeyBinding& binding);

/// Held down for as long as it is to last.
bool is_held(KeyAction action);

}  // namespace myotact::view
