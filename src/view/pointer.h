#pragma once

#include "view/layout.h"
#include "view/view_controls.h"
#include "view/view_state.h"

namespace myotact::view {

/// The mouse over the scene: turns, shifts and brings nearer the camera; with Ctrl held it is the hand, in the plane of
/// the picture, with the wheel for its depth. Between ImGui's NewFrame and Render, after the panels.
void move_by_pointer(const Area& scene, ViewState& view, ViewControls& controls);

}  // namespace myotact::view
