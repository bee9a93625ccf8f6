#pragma once

#include "view/panels/panel.h"

namespace myotact::view {

/// Along the bottom: by how much force and motion are scaled, and whether the computer keeps up.
void draw_status_bar(const PanelContext& context);

}  // namespace myotact::view
