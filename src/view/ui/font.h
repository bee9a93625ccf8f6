#pragma once

namespace myotact::view::ui {

/// Adds the font of the interface to the current ImGui context; ImGui's own where it is not installed.
void add_font(float height_px);

}  // namespace myotact::view::ui
