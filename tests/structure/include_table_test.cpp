#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/file.h"
#include "core/text.h"
#include "support/source_folder.h"

// Which folder may include which: the table of the design, so that the arrows of the data flow stay as drawn. The
// same between the parts of the folders that have some.

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
    {"exchange",
     {"measure", "remote", "net", "scene", "layer", "simulation", "haptics", "device", "anatomy", "realtime",
      "messages", "geometry"}},
    {"app",
     {"exchange", "measure", "scene", "layer", "simulation", "haptics", "device", "anatomy", "realtime", "messages",
      "geometry", "view", "learn", "net", "remote"}},
};

/// Of tools/: what each program may include of src/ besides its own folder and core.
const std::map<std::string, Folders> kToolsMayInclude = {
    {"prepare", {"geometry", "anatomy", "view"}},  // view: the pictures of the report
    {"fit_texture", {"haptics"}},
    {"plain_specimens", {"geometry", "anatomy"}},
};

/// A folder whose parts are folders, too: which part may include which. What lies beside them puts them together and
/// may include all; `basics` is what lies there and all may include.
struct Rooms {
  Folders basics;
  std::map<std::string, Folders> may_include;
};

const std::map<std::string, Rooms> kRooms = {
    {"simulation",
     {{"time_rule.h", "worker_pool.h"},
      {{"simd", {}},
       {"curves", {}},
       {"skeleton", {}},
       {"contact", {}},
       {"skin", {}},
       {"particle", {}},
       {"linear", {"simd"}},
       {"material", {"simd", "curves"}},
       {"element", {"simd", "linear", "material"}},
       {"line", {"curves", "skeleton"}},
       {"muscle", {"contact", "curves", "element", "line", "linear", "material", "simd", "skeleton"}},
       {"follower", {"line", "skeleton", "skin"}},
       {"limb", {"contact", "follower", "line", "linear", "muscle", "skeleton", "skin"}},
       {"touch", {"limb", "line", "muscle", "skin"}},
       {"solid", {"element", "linear", "material", "simd"}}}}},
    {"haptics",
     {{"faults.h", "force_method.h", "force_parts.h", "haptic_settings.h"},
      {{"gate", {}}, {"proxy", {}}, {"effects", {"gate", "proxy"}}}}},
    {"view",
     {{},
      {{"ui", {}},
       {"look", {}},
       {"sound", {}},
       {"charts", {"ui"}},
       {"input", {"ui"}},
       {"state", {"look"}},
       {"render", {"charts", "look"}},
       {"overlay", {"look", "render", "ui"}},
       {"pictures", {"look", "overlay", "render", "ui"}},
       {"session", {"input", "look", "state", "ui"}},
       {"panels", {"charts", "input", "look", "render", "session", "state", "ui"}},
       {"window", {"input", "look", "overlay", "panels", "pictures", "render", "session", "sound", "state", "ui"}}}}},
    {"prepare",
     {{"cgal_mesh.h", "child_process.h", "limb_work.h", "parallel.h"},
      {{"surface", {}},
       {"field", {"surface"}},
       {"remesh", {"field"}},
       {"repair", {"field", "remesh", "surface"}},
       {"volume", {"recipe"}},
       {"recipe", {"surface"}},
       {"guess", {"recipe", "surface"}},
       {"loft", {"recipe"}},
       {"part", {"field", "recipe", "surface"}},
       {"partition", {"part", "recipe", "remesh", "volume"}},
       {"measure", {"field", "part", "partition", "surface", "volume"}},
       {"architecture", {"field", "recipe"}},
       {"tets", {"field", "remesh"}},
       {"check", {"field", "part", "remesh", "tets"}},
       {"report", {"repair", "tets"}},
       {"stages", {"architecture", "field", "part", "remesh", "repair", "surface"}}}}},
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

/// The first folder of a path; empty for a file alone.
std::string first_of(const std::string& path) {
  const std::size_t slash = path.find('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

/// What is wrong with an include of `path` in a file of one of src's folders, or of one of tools'; empty when the table
/// allows it.
std::string offence(const std::map<std::string, Folders>& table, const std::string& folder, const std::string& path) {
  const std::string other = first_of(path);
  if (other.empty()) return "must be written with its folder, as \"folder/" + path + "\"";
  if (other == folder || other == "core") return "";
  if (!table.at(folder).contains(other)) return folder + " may not include " + other;
  const bool reaches_into_device = folder == "haptics" && other == "device" && path != "device/device.h";
  return reaches_into_device ? "haptics may include device's interface only" : "";
}

/// The same between the parts of one folder; `part` of the file, `path` as it is included, from the folder on.
std::string offence_between(const Rooms& rooms, const std::string& part, const std::string& path) {
  const std::string other = first_of(path);
  if (part.empty() || other == part) return "";
  if (!rooms.may_include.contains(part)) return part + " is not in the table of parts";
  if (other.empty()) return rooms.basics.contains(path) ? "" : part + " may not include " + path;
  return rooms.may_include.at(part).contains(other) ? "" : part + " may not include " + other;
}

/// All of one file's offences, one a line.
std::string offences(const std::map<std::string, Folders>& table, const std::string& folder, const std::string& place,
                     const std::string& source) {
  std::string found;
  const auto rooms = kRooms.find(folder);
  for (const std::string& path : quoted_includes(source)) {
    std::string what = offence(table, folder, path);
    if (what.empty() && rooms != kRooms.end() && first_of(path) == folder) {
      what = offence_between(rooms->second, first_of(place), path.substr(folder.size() + 1));
    }
    if (!what.empty()) found += "#include \"" + path + "\": " + what + "\n";
  }
  return found;
}

/// How many files of the folders of `top` were read.
int check_all(const std::filesystem::path& top, const std::map<std::string, Folders>& table) {
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(top)) {
    const auto& path = entry.path();
    if (path.extension() != ".h" && path.extension() != ".cpp") continue;
    ++files;
    const std::filesystem::path inside = path.lexically_relative(top);
    const std::string folder = inside.begin()->string();
    EXPECT_TRUE(table.contains(folder)) << path << ": its folder is not in the table";
    if (!table.contains(folder)) continue;
    EXPECT_EQ(offences(table, folder, inside.lexically_relative(folder).generic_string(), read_file(path)), "") << path;
  }
  return files;
}

/// Whether following the table from `part` leads back to it.
bool leads_back(const std::map<std::string, Folders>& table, const std::string& part) {
  Folders reached;
  std::vector<std::string> open = {part};
  while (!open.empty()) {
    const std::string here = open.back();
    open.pop_back();
    for (const std::string& next : table.at(here)) {
      if (next == part) return true;
      if (reached.insert(next).second) open.push_back(next);
    }
  }
  return false;
}

TEST(IncludeTable, FindsWhatItForbids) {
  EXPECT_EQ(quoted_includes("#pragma once\n#include <map>\n #include \"a/b.h\"  // why\n// #include \"c/d.h\"\n"),
            std::vector<std::string>{"a/b.h"});
  EXPECT_EQ(offence(kMayInclude, "anatomy", "geometry/tet_mesh.h"), "");
  EXPECT_EQ(offence(kMayInclude, "haptics", "device/device.h"), "");
  EXPECT_NE(offence(kMayInclude, "haptics", "simulation/simulation.h"), "");
  EXPECT_NE(offence(kMayInclude, "simulation", "haptics/proxy/proxy.h"), "");
  EXPECT_NE(offence(kMayInclude, "haptics", "device/mouse_device.h"), "");
  EXPECT_NE(offence(kMayInclude, "core", "geometry/tet_mesh.h"), "");
  EXPECT_NE(offence(kMayInclude, "core", "error.h"), "");
  EXPECT_NE(offence(kToolsMayInclude, "prepare", "simulation/simulation.h"), "");
  EXPECT_EQ(offences(kMayInclude, "simulation", "limb/step.cpp", "#include \"simulation/muscle/tissue_pass.h\"\n"), "");
  EXPECT_NE(offences(kMayInclude, "simulation", "muscle/tissue_pass.h", "#include \"simulation/limb/limb.h\"\n"), "");
  EXPECT_NE(offences(kMayInclude, "simulation", "limb/limb.h", "#include \"simulation/simulation.h\"\n"), "");
  EXPECT_EQ(offences(kMayInclude, "simulation", "limb/limb.h", "#include \"simulation/worker_pool.h\"\n"), "");
  EXPECT_EQ(offences(kMayInclude, "simulation", "simulation.cpp", "#include \"simulation/limb/limb.h\"\n"), "");
  EXPECT_NE(offences(kToolsMayInclude, "prepare", "field/level_set.h", "#include \"prepare/repair/soup.h\"\n"), "");
}

TEST(IncludeTable, EveryFileKeepsToIt) {
  const std::filesystem::path project = source_folder();
  EXPECT_GT(check_all(project / "src", kMayInclude), 500);
  EXPECT_GT(check_all(project / "tools", kToolsMayInclude), 100);
}

TEST(IncludeTable, NoPartLeadsBackToItself) {
  for (const auto& [folder, rooms] : kRooms) {
    for (const auto& [part, others] : rooms.may_include) {
      EXPECT_FALSE(leads_back(rooms.may_include, part)) << folder << "/" << part;
    }
  }
  EXPECT_TRUE(leads_back({{"a", {"b"}}, {"b", {"a"}}}, "a"));
}

}  // namespace
}  // namespace myotact
