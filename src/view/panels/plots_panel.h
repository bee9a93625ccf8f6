#pragma once

#include "view/panels/panel.h"
#include "view/plot.h"

namespace myotact::view {

/// Curves of the last seconds.
class PlotsPanel {
 public:
  /// Every picture, drawn or not, so that no curve has gaps.
  void add(const PanelContext& context);
  void draw();

 private:
  Plot angle_{"plots.angle", 4.0};
  Plot stiffness_{"plots.stiffness", 1.0};
  Plot force_{"plots.force", 1.0};  // of all tools, added up
};

}  // namespace myotact::view
