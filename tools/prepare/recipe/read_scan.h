#pragma once

#include <filesystem>
#include <vector>

#include "prepare/recipe/anatomy_data.h"
#include "prepare/recipe/named_surface.h"

namespace myotact::prepare {

/// A folder of scanned surfaces: bones/KEY.stl and muscles/KEY.stl.
struct Scan {
  std::vector<NamedSurface> bones, muscles;
};

/// Reads the surfaces that the anatomy names; other files are left alone. Throws Error: NoInput when a folder is not
/// there or holds none of them, BadData for a file that is no surface.
Scan read_scan(const std::filesystem::path& folder, const AnatomyData& anatomy);

}  // namespace myotact::prepare
