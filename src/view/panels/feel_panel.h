#pragma once

#include "view/panels/panel.h"

namespace myotact::view {

/// What the hand feels now, beside what its device can give.
class FeelPanel {
 public:
  void draw(PanelContext& context);
};

}  // namespace myotact::view
