#pragma once

#include <string>

#include "view/layout.h"
#include "view/panels/panel.h"

namespace myotact::view {

/// What a picture showed, as JSON: parts that are selected, hidden and faded by key, what is set of the scene, what the
/// frame holds of joints and tools, and the controls with their places.
std::string describe(const PanelContext& context, const Layout& layout, bool looking_back);

}  // namespace myotact::view
