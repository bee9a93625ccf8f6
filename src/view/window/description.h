#pragma once

#include <string>

#include "view/panels/panel.h"
#include "view/ui/layout.h"

namespace myotact::view {

/// Which moment a picture showed.
struct ShownMoment {
  bool looking_back = false;
  bool turning = false;   // on the way to another view
  double newest_s = 0.0;  // of the simulation, simulated time
};

/// What a picture showed, as JSON: parts that are selected, hidden and faded by key, what is set of the scene, what the
/// frame holds of joints and tools, the devices on the table, the controls with their places, and the picture's number.
std::string describe(const PanelContext& context, const Layout& layout, const ShownMoment& moment);

}  // namespace myotact::view
