#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/file.h"
#include "core/text.h"

// Which folder of src/ may include which; the table of the design, so that the arrows of the data flow stay as drawn.

namespace myotact {
namespace {

using Folders = std::set<std::string>;

/// Besides itself and core.
const std::map<std::string, Folders> kMayInclude = {
    {"core", {}},
    {"realtime", {}},
    {"messages", {}},
    {"geometry", {}},
    {"anatomy", {"geometry"}},
    {"device", {"realtime", "messages"}},
    {"net", {"realtime", "messages"}},
    {"haptics", {"realtime", "messages", "geometry", "device"}},
    {"simulation", {"realtime", "messages", "geometry", "anatomy"}},
    {"learn", {"messages", "geometry", "anatomy"}},
    {"view", {"messages", "geometry", "anatomy", "learn"}},
    {"layer", {"simulation", "haptics", "device", "anatomy", "realtime", "messages", "geometry"}},
    {"scene", {"layer", "simulation", "haptics", "device", "anatomy", "realtime", "messages", "geometry"}},
    {"remote",
     {"net", "scene", "layer", "simulation", "haptics", "device", "anatomy", "realtime", "messages", "geometry"}},
    {"measure",
     {"remote", "net", "scene", "layer", "simulation", "haptics", "device", "anatomy", "realtime", "messages",
      "geometry"}},
    {"app",
     {"measure", "scene", "layer", "simulation", "haptics", "device", "anatomy", "realtime", "messages", "geometry",
      "view", "learn", "net", "remote"}},
};

/// The paths between quotes after #include; system headers stand between angle brackets.
std::vector<std::string> quoted_includes(const std::string& source) {
  std::vector<std::string> paths;
  std::size_t start = 0;
  while (start < source.size()) {
    const std::size_t end = std::min(source.find('\n', start), source.size());
    const auto words = words_of(std::string_view(source).substr(start, end - start));
    start = end + 1;
    if (words.size() < 2 || words[0] != "#include" || words[1].size() < 2 || words[1].front() != '"') continue;
    paths.emplace_back(words[1].substr(1, words[1].size() - 2));
  }
  return paths;
}

/// What is wrong with an include of `path` in a file of `folder`; empty when the table allows it.
std::string offence(const std::string& folder, const std::string& path) {
  const std::size_t slash = path.find('/');
  if (slash == std::string::npos) return "must be written with its folder, as \"folder/" + path + "\"";
  const std::string other = path.substr(0, slash);
  if (other == folder || other == "core") return "";
  if (!kMayInclude.at(folder).contains(other)) return folder + " may not include " + other;
  const bool reaches_into_device = folder == "haptics" && other == "device" && path != "device/device.h";
  return reaches_into_device ? "haptics may include device's interface only" : "";
}

TEST(IncludeTable, FindsWhatItForbids) {
  EXPECT_EQ(quoted_includes("#pragma once\n#include <map>\n #include \"a/b.h\"  // why\n// #include \"c/d.h\"\n"),
            std::vector<std::string>{"a/b.h"});
  EXPECT_EQ(offence("anatomy", "geometry/tet_mesh.h"), "");
  EXPECT_EQ(offence("haptics", "device/device.h"), "");
  EXPECT_NE(offence("haptics", "simulation/simulation.h"), "");
  EXPECT_NE(offence("simulation", "haptics/proxy.h"), "");
  EXPECT_NE(offence("haptics", "device/mouse_device.h"), "");
  EXPECT_NE(offence("core", "geometry/tet_mesh.h"), "");
  EXPECT_NE(offence("core", "error.h"), "");
}

TEST(IncludeTable, EveryFileKeepsToIt) {
  const std::filesystem::path source = std::filesystem::path(MYOTACT_SOURCE_DIR) / "src";
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source)) {
    const auto& path = entry.path();
    if (path.extension() != ".h" && path.extension() != ".cpp") continue;
    ++files;
    const std::string folder = path.lexically_relative(source).begin()->string();
    ASSERT_TRUE(kMayInclude.contains(folder)) << path << ": its folder is not in the table";
    for (const std::string& included : quoted_includes(read_file(path))) {
      EXPECT_EQ(offence(folder, included), "") << path << ": #include \"" << included << "\"";
    }
  }
  EXPECT_GT(files, 100);
}

}  // namespace
}  // namespace myotact
