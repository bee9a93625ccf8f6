#pragma once

#include <filesystem>

namespace myotact {

/// The folder that holds shaders/, assets/ and meshes/ (and tests/validation/, in a source tree): MYOTACT_DATA_DIR if
/// set, else the source tree the program was built from, else the nearest folder above the executable that holds them.
/// Throws Error NoInput naming the remedy.
const std::filesystem::path& data_folder();

}  // namespace myotact
