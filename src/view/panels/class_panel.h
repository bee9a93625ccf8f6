#pragma once

#include "view/panels/panel.h"
#include "view/ui/layout.h"

namespace myotact::view {

/// What a class reads from the last row: the joint's stiffness and angle and how much its muscles contract together,
/// with the two buttons that change that, at the left of the scene.
void draw_class_panel(PanelContext& context, const Area& scene);

}  // namespace myotact::view
