#pragma once

#include <filesystem>
#include <vector>

#include "prepare/recipe/named_surface.h"

namespace myotact::prepare {

/// Closed muscle surfaces from the elliptical sections of forelimb_muscle_sections.json: centres and ellipses are
/// interpolated along the muscle, so that rings lie about 4 mm apart. Throws Error NoInput or BadData.
std::vector<NamedSurface> loft_muscles(const std::filesystem::path& folder);

/// Closed bone surfaces from the outlines of forelimb_bone_outlines.json. Throws as above.
std::vector<NamedSurface> loft_bones(const std::filesystem::path& folder);

}  // namespace myotact::prepare
