#pragma once

#include <array>
#include <string_view>

namespace myotact::view {

/// What a key does. One table makes the handler and the help, so that they cannot disagree.
enum class KeyAction {
  Help,
  PauseOrPlay,
  Step,
  Reset,
  Lateral,
  Medial,
  Cranial,
  Caudal,
  Dorsal,
  Palmar,
  FrameAll,
  GrabLine,
  GrabBone,
  StopForces,
  EnableForces,
  Screenshot
};

struct KeyBinding {
  int key;  // GLFW_KEY_*
  KeyAction action;
  std::string_view name;  // of the key, as the help shows it
  std::string_view what;
};

/// All bindings, in the order of the help.
const std::array<KeyBinding, 16>& key_bindings();

}  // namespace myotact::view
