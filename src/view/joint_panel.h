#pragma once

#include "messages/scene_frame.h"
#include "view/joint_readings.h"
#include "view/view_controls.h"

namespace myotact::view {

/// Stiffness of the joint on show with its band, its parts as bars, why it is so, and the shove test. Draws with ImGui
/// into the window that is open.
void draw_joint(const messages::JointFrame& joint, const JointReadings& readings, ViewControls& controls);

}  // namespace myotact::view
