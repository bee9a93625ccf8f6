#pragma once

#include "view/panels/panel.h"

namespace myotact::view {

/// The menu of a part, which opens under the pointer: hide, fade, isolate, plot, origin and insertion.
class PartMenu {
 public:
  /// Opens where context.asks.menu_of names a part, and draws while open.
  void draw(PanelContext& context);

 private:
  Part part_;
};

}  // namespace myotact::view
