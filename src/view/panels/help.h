#pragma once

#include <vector>

#include "view/input/key_bindings.h"
#include "view/input/mouse_preset.h"

namespace myotact::view {

/// Keys and mouse, over everything; `open` becomes false when it is closed. True when the person asks to be shown
/// round.
bool draw_help(bool& open, const std::vector<KeyBinding>& bindings, MousePreset mouse);

}  // namespace myotact::view
