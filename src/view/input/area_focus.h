#pragma once

#include "view/ui/layout.h"

namespace myotact::view {

/// The pointer of the keyboard goes to the next area that is shown (toolbar, find, tasks, timeline), within them to
/// what scrolls, or with `step` -1 to the one before. Before the areas are drawn, between ImGui's NewFrame and Render.
void focus_next_area(const Layout& layout, int step);

}  // namespace myotact::view
