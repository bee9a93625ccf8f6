#include "core/user_folder.h"

#include <chrono>
#include <cstdlib>
#include <ctime>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "core/error.h"
#include "core/file.h"

namespace myotact {

namespace {

std::filesystem::path folder_of(const char* variable) {
  const char* value = std::getenv(variable);
  return value == nullptr ? std::filesystem::path() : std::filesystem::path(value);
}

/// The folder that the variable names, or else that one of the home.
std::filesystem::path own_folder(const char* variable, const std::filesystem::path& in_home) {
  // The specification wants an absolute path, and says to ignore others.
  if (const auto named = folder_of(variable); named.is_absolute()) return named / "myotact";
  const auto home = folder_of("HOME");
  return home.empty() ? home : home / in_home / "myotact";
}

}  // namespace

std::filesystem::path user_data_folder() {
  return own_folder("XDG_DATA_HOME", ".local/share");
}

std::filesystem::path user_config_folder() {
  return own_folder("XDG_CONFIG_HOME", ".config");
}

std::filesystem::path new_user_path(const std::string& kind, const std::string& name, const std::string& extension) {
  const std::filesystem::path own = user_data_folder();
  if (own.empty()) {
    throw Error(ExitStatus::InputOutput, "there is no folder for your files: set HOME or XDG_DATA_HOME to one");
  }
  make_writable_folder(own / kind);
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  const std::string stem = fmt::format("{}_{:%Y-%m-%d_%H.%M.%S}", name, fmt::localtime(now));
  std::filesystem::path path = own / kind / (stem + extension);
  for (int i = 2; std::filesystem::exists(path); ++i) path = own / kind / fmt::format("{}_{}{}", stem, i, extension);
  return path;
}

}  // namespace myotact
