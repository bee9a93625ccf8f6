#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "prepare/recipe/anatomy_data.h"
#include "prepare/recipe/named_surface.h"

namespace myotact::prepare {

/// The surfaces that were found for the recipe's bones and muscles, in the recipe's order.
struct Scan {
  std::vector<NamedSurface> bones, muscles;
  std::vector<std::string> notes;  // what a person should know: odd headers, files that the recipe does not name
};

/// Reads folders that hold bones/ and muscles/, or single files, in any format of read_surface(). A file belongs to the
/// part whose file the recipe names, or whose key its name is; the extension does not matter. Coordinates stay as they
/// are in the files. Throws Error: NoInput when something is not there or nothing fits the recipe, BadData when a file
/// is broken or two fit one part.
Scan read_scan(const std::vector<std::filesystem::path>& inputs, const AnatomyData& recipe);

}  // namespace myotact::prepare
