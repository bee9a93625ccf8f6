#pragma once

#include <vector>

#include "prepare/limb_work.h"
#include "prepare/recipe/named_surface.h"

namespace myotact::prepare {

/// The parts of the recipe that the input has surfaces for, in the recipe's order, and the parts to be built. Throws
/// Error BadData when the recipe has bones, or muscles, and none of them is among the surfaces.
LimbWork make_limb(const AnatomyData& recipe, const std::vector<NamedSurface>& bones,
                   const std::vector<NamedSurface>& muscles, const PrepareSettings& settings);

}  // namespace myotact::prepare
