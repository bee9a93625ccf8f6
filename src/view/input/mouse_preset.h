#pragma once

#include <optional>
#include <span>

namespace myotact::view {

/// Which drags move the camera: as in anatomy programs, without a middle button or wheel, or as in Blender.
enum class MousePreset { ThreeButton, Trackpad, Blender };

enum class CameraDrag { Rotate, Shift, Nearer };

/// One drag. Rows without modifiers of the left button hold while the mouse looks: else it is the hand's.
struct MouseRow {
  int button;  // 0 left, 1 right, 2 middle
  int mods;    // GLFW_MOD_*, of Shift, Ctrl and Alt: exactly these
  CameraDrag drag;
  const char* how;   // key of the text "right drag"
  const char* what;  // key of the text "shifts the picture"
};

/// The table that the pointer follows and the help shows.
std::span<const MouseRow> mouse_rows(MousePreset preset);

/// What a button begins that goes down with these modifiers; nothing: it is not the camera's. `looking`: the mouse is
/// not the hand.
std::optional<CameraDrag> camera_drag(MousePreset preset, int button, int mods, bool looking);

/// Blender's views on the number pad, its front being cranial; null: no such key. With Ctrl from the opposite side.
const char* number_pad_view(int key, int mods);

}  // namespace myotact::view
