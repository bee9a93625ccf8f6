#pragma once

#include "view/panels/panel.h"

namespace myotact::view {

/// Along the bottom: what a person should know now, rates, and that this is no medical device.
void draw_status_bar(const PanelContext& context);

}  // namespace myotact::view
