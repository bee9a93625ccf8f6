#pragma once

#include <string>

#include "view/settings.h"

namespace myotact::view {

/// Language and theme: they change at once, and are kept. `message`: why they could not be.
void draw_settings_panel(Settings& settings, std::string& message);

}  // namespace myotact::view
