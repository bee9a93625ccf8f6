#pragma once

#include "haptics/effects/bone_drag.h"
#include "haptics/effects/line_snap.h"
#include "haptics/effects/muscle_line_drag.h"
#include "haptics/effects/texture_set.h"
#include "haptics/force_method.h"
#include "haptics/gate/force_gate.h"
#include "haptics/proxy/contact_settings.h"
#include "messages/held_tool.h"

namespace myotact::haptics {

struct HapticSettings {
  /// Penetration and Plane have no friction, damping, texture or compliance. Their k is the contact's stiffness, as far
  /// as the device supports it (stiffness_bound.h), and no more than the force that may be sent over the depenetration.
  ForceMethod method = ForceMethod::Proxy;
  ContactSettings contact;
  LineDragSettings line;
  LineSnapSettings snap;
  BoneDragSettings bone;  // its force scale is the loop's
  GateSettings gate;
  TextureSettings texture;
  /// Felt over simulated force: muscles pull with 10-1000 N, devices with 3-20 N. The tissue gets the unscaled force.
  double force_scale = 1.0;
  /// A clamp: either button takes the nearest bone, none a muscle line.
  messages::ToolShape shape = messages::ToolShape::Ball;
  /// Stiffnesses stay within what the device supports (stiffness_bound.h) and what the age of the simulation's answer
  /// leaves of it. False: for measurements of where a loop becomes unstable.
  bool limit_stiffness = true;
};

}  // namespace myotact::haptics
