#include "core/data_folder.h"

#include <cstdlib>
#include <optional>

#include "core/error.h"

namespace myotact {

namespace {

bool holds_data(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::is_directory(folder / "shaders", ignored) &&
         std::filesystem::is_directory(folder / "assets", ignored);
}

/// PREFIX/share/myotact of PREFIX/bin/myotact. In a build folder that is a link to the sources (MyotactInstall.cmake):
/// no path is compiled in, and what is installed can be moved.
std::optional<std::filesystem::path> above_executable() {
  std::error_code failure;
  auto folder = std::filesystem::read_symlink("/proc/self/exe", failure).parent_path();
  while (!failure && folder.has_relative_path()) {
    const auto data = folder / "share" / "myotact";
    if (holds_data(data)) return std::filesystem::canonical(data);
    folder = folder.parent_path();
  }
  return std::nullopt;
}

std::filesystem::path& suggested_folder() {
  static std::filesystem::path folder;
  return folder;
}

std::filesystem::path find_data_folder() {
  if (const char* given = std::getenv("MYOTACT_DATA_DIR")) {
    if (!holds_data(given)) {
      throw Error(ExitStatus::NoInput, std::string("MYOTACT_DATA_DIR=") + given +
                                           ": holds no shaders/ and assets/; name the folder that does");
    }
    return given;
  }
  if (!suggested_folder().empty() && holds_data(suggested_folder())) return suggested_folder();
  if (const auto found = above_executable()) return *found;
  throw Error(ExitStatus::NoInput,
              "the folder with shaders/, assets/ and meshes/ is not found; name it in the variable MYOTACT_DATA_DIR");
}

}  // namespace

void suggest_data_folder(const std::filesystem::path& folder) {
  suggested_folder() = folder;
}

const std::filesystem::path& data_folder() {
  static const std::filesystem::path folder = find_data_folder();
  return folder;
}

}  // namespace myotact
