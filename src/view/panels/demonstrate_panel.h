#pragma once

#include "view/panels/panel.h"

namespace myotact::view {

/// The co-contraction bench: what the muscles are told, and how stiff the joint is for it, and why.
class DemonstratePanel {
 public:
  void draw(PanelContext& context);
};

}  // namespace myotact::view
