#include <algorithm>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "core/file.h"
#include "support/source_folder.h"

// Small files are easier to trust: no header beyond 250 lines, no source beyond 400, no test beyond 500.

namespace myotact {
namespace {

std::ptrdiff_t line_limit(const std::filesystem::path& path) {
  if (path.extension() == ".h") return 250;
  return path.string().ends_with("_test.cpp") ? 500 : 400;
}

TEST(FileSize, EveryFileStaysSmall) {
  int files = 0;
  for (const char* folder : {"src", "tools", "tests"}) {
    const auto root = std::filesystem::path(source_folder()) / folder;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
      const auto& path = entry.path();
      if (path.extension() != ".h" && path.extension() != ".cpp") continue;
      ++files;
      const std::string text = read_file(path);
      EXPECT_LE(std::count(text.begin(), text.end(), '\n'), line_limit(path)) << path << ": split it by topic";
    }
  }
  EXPECT_GT(files, 200);
}

}  // namespace
}  // namespace myotact
