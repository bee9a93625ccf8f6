#pragma once

#include <filesystem>

#include "prepare/recipe/anatomy_data.h"

namespace myotact::prepare {

/// Reads forelimb_anatomy.json of the folder (assets/canine/README.md tells its keys): bodies, bones, joints, mechanics
/// and attachments of the muscles, groups. Throws Error NoInput or BadData naming file, place and remedy.
AnatomyData read_anatomy(const std::filesystem::path& folder);

}  // namespace myotact::prepare
