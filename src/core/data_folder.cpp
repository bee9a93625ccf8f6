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

std::optional<std::filesystem::path> above_executable() {
  std::error_code failure;
  auto folder = std::filesystem::read_symlink("/proc/self/exe", failure).parent_path();
  while (!failure && folder.has_relative_path()) {
    if (holds_data(folder)) return folder;
    if (holds_data(folder / "share" / "myotact")) return folder / "share" / "myotact";
    folder = folder.parent_path();
  }
  return std::nullopt;
}

std::filesystem::path find_data_folder() {
  if (const char* given = std::getenv("MYOTACT_DATA_DIR")) {
    if (!holds_data(given)) {
      throw Error(ExitStatus::NoInput, std::string("MYOTACT_DATA_DIR=") + given +
                                           ": holds no shaders/ and assets/; name the folder that does");
    }
    return given;
  }
  if (holds_data(MYOTACT_SOURCE_DIR)) return MYOTACT_SOURCE_DIR;
  if (const auto found = above_executable()) return *found;
  throw Error(ExitStatus::NoInput,
              "the folder with shaders/, assets/ and meshes/ is not found; name it in the variable MYOTACT_DATA_DIR");
}

}  // namespace

const std::filesystem::path& data_folder() {
  static const std::filesystem::path folder = find_data_folder();
  return folder;
}

}  // namespace myotact
