#pragma once

#include <filesystem>

#include "prepare/recipe/anatomy_data.h"

namespace myotact::prepare {

/// Reads a recipe (assets/canine/README.md lists its keys): bodies, bones, joints, mechanics and attachments of the
/// muscles, groups, parts to build, files to leave out. Throws Error NoInput or BadData naming file, place and remedy.
AnatomyData read_recipe(const std::filesystem::path& file);

}  // namespace myotact::prepare
