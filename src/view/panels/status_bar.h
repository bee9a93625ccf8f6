#pragma once

#include <string>

#include "view/panels/panel.h"

namespace myotact::view {

/// Along the bottom: what a person should know now, and whether the computer keeps up. `message`: a sentence that stays
/// until it is dismissed; empty: none.
void draw_status_bar(PanelContext& context, std::string& message);

}  // namespace myotact::view
