#pragma once

#include <filesystem>
#include <string>

namespace myotact {

/// Where a person's own files lie, by the XDG base directory specification: $XDG_DATA_HOME/myotact, or
/// ~/.local/share/myotact in its place. Empty without a home.
std::filesystem::path user_data_folder();

/// Where settings lie: $XDG_CONFIG_HOME/myotact, or ~/.config/myotact in its place. Empty without a home.
std::filesystem::path user_config_folder();

/// A path of that folder's folder `kind` that is not taken yet, by local time, without blanks:
/// "KIND/NAME_2026-03-01_14.05.09". Makes the folder. Throws Error InputOutput where nothing can be written, or without
/// a home.
std::filesystem::path new_user_path(const std::string& kind, const std::string& name, const std::string& extension);

}  // namespace myotact
