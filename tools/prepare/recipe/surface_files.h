#pragma once

#include <filesystem>
#include <vector>

namespace myotact::prepare {

/// The surface files of a scan's folder by name, so that the order never depends on the disk: those in its bones/ and
/// muscles/, or, where it has neither, those that lie in itself. Throws Error NoInput where there can be none.
std::vector<std::filesystem::path> surface_files_in(const std::filesystem::path& folder);

/// By its extension.
bool is_surface_file(const std::filesystem::path& file);

}  // namespace myotact::prepare
