#pragma once

#include <filesystem>
#include <vector>

#include "prepare/recipe/named_surface.h"

namespace myotact::prepare {

/// Closed muscle surfaces from the elliptical sections in NAME_muscle_sections.json beside the recipe NAME.json:
/// centres and ellipses are interpolated along the muscle, so that rings lie about 4 mm apart. Throws Error NoInput or
/// BadData.
std::vector<NamedSurface> loft_muscles(const std::filesystem::path& recipe);

/// Closed bone surfaces from the outlines in NAME_bone_outlines.json. Throws as above.
std::vector<NamedSurface> loft_bones(const std::filesystem::path& recipe);

}  // namespace myotact::prepare
