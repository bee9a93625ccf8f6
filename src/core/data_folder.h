#pragma once

#include <filesystem>

namespace myotact {

/// The folder that holds shaders/, assets/, meshes/ and tests/validation/: MYOTACT_DATA_DIR if set, else the nearest
/// share/myotact above the executable, which in a build folder is a link to the sources.
/// Throws Error NoInput naming the remedy.
const std::filesystem::path& data_folder();

}  // namespace myotact
