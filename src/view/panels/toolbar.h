#pragma once

#include "view/panels/panel.h"

namespace myotact::view {

/// Along the top: play, step, reset, forces off, the standard views, undo.
struct ToolbarAsks {
  const char* standard_view = nullptr;  // to look from; null: none
  bool undo = false, redo = false, help = false;
};
ToolbarAsks draw_toolbar(PanelContext& context, bool can_undo, bool can_redo);

}  // namespace myotact::view
