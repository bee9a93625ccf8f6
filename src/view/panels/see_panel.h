#pragma once

#include "view/panels/panel.h"

namespace myotact::view {

/// How the limb is shown: what colours mean, layers, names, fibres, attachments, a section.
void draw_see_panel(PanelContext& context);

}  // namespace myotact::view
