#pragma once

#include "view/panels/panel.h"
#include "view/pointer.h"

namespace myotact::view {

struct UndoState {
  bool can_undo = false, can_redo = false;
};

/// Along the top: what the mouse is, play, save and open, the standard views, undo, help, and in red: forces off.
void draw_toolbar(PanelContext& context, Pointer& pointer, const UndoState& undo);

}  // namespace myotact::view
