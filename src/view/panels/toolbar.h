#pragma once

#include "view/panels/panel.h"

namespace myotact::view {

struct ToolbarState {
  PointerMode pointer = PointerMode::Look;
  bool free_orbit = false;  // a drag rotates the limb any way
  bool can_undo = false, can_redo = false;
};

/// Along the top: what the mouse is, play, save and open, the standard views, undo, help, and in red: forces off.
void draw_toolbar(PanelContext& context, const ToolbarState& state);

}  // namespace myotact::view
