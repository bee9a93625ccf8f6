#pragma once

#include "anatomy/specimen.h"
#include "view/look/view_state.h"

namespace myotact::view {

/// Everything shown, seen from the lateral side. `aspect`: width over height of the picture.
ViewState start_view(const anatomy::Specimen& specimen, float aspect);

}  // namespace myotact::view
