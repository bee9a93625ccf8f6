#pragma once

#include <filesystem>

namespace myotact {

/// The folder that holds shaders/, assets/, meshes/ and tests/validation/: MYOTACT_DATA_DIR if set, else the nearest
/// share/myotact above the executable, which in a build folder is a link to the sources.
/// Throws Error NoInput naming the remedy.
const std::filesystem::path& data_folder();

/// Where a library that is not beside its executable has its data: used before the executable's own surroundings, after
/// MYOTACT_DATA_DIR. Without effect once data_folder() has found one.
void suggest_data_folder(const std::filesystem::path& folder);

}  // namespace myotact
