#pragma once

#include "view/panels/panel.h"

namespace myotact::view {

/// At the left: the muscles, what they do now.
class FindPanel {
 public:
  void draw(PanelContext& context);
};

}  // namespace myotact::view
