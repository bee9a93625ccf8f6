#pragma once

#include "view/panels/panel.h"

namespace myotact::view {

/// Of any tool, until forces are enabled again.
bool forces_stopped(const messages::SceneFrame& frame);

/// A button in red: what it does is felt at once.
bool red_button(const char* key);

}  // namespace myotact::view
