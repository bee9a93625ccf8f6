#include <algorithm>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/file.h"
#include "support/source_folder.h"

// What a README or a page of docs/ points at is there: links, paths from the top of the repository, and the parts of a
// folder's table, which names all of them.

namespace myotact {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = source_folder();
const std::vector<std::string> kTopFolders = {"assets",  "cmake", "docs",  "meshes", "paper",
                                              "shaders", "src",   "tests", "tools"};

/// The texts between each `opening` and the `closing` after it.
std::vector<std::string> texts_between(const std::string& text, const std::string& opening, char closing) {
  std::vector<std::string> found;
  std::size_t start = text.find(opening);
  while (start != std::string::npos) {
    start += opening.size();
    const std::size_t end = std::min(text.find(closing, start), text.size());
    found.push_back(text.substr(start, end - start));
    start = text.find(opening, std::min(end + 1, text.size()));
  }
  return found;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t start = 0; start < text.size(); start += lines.back().size() + 1) {
    lines.push_back(text.substr(start, text.find('\n', start) - start));
  }
  return lines;
}

/// The text without its ``` blocks, which hold commands and formats.
std::string prose_of(const std::string& text) {
  std::string prose;
  bool in_block = false;
  for (const std::string& line : lines_of(text)) {
    const bool fence = line.starts_with("```");
    if (fence) in_block = !in_block;
    if (!in_block && !fence) prose += line + '\n';
  }
  return prose;
}

bool is_from_the_top(const std::string& path) {
  const auto slash = path.find('/');
  if (slash == std::string::npos || path.find(' ') != std::string::npos) return false;
  return std::find(kTopFolders.begin(), kTopFolders.end(), path.substr(0, slash)) != kTopFolders.end();
}

/// Links and paths from the top that lead nowhere.
std::vector<std::string> lost_paths(const std::string& prose, const fs::path& folder) {
  std::vector<std::string> lost;
  for (const std::string& target : texts_between(prose, "](", ')')) {
    const std::string file = target.substr(0, target.find('#'));
    if (target.find("://") == std::string::npos && !fs::exists(folder / file)) lost.push_back(target);
  }
  for (const std::string& path : texts_between(prose, "`", '`')) {
    if (is_from_the_top(path) && !fs::exists(kRoot / path) && !fs::exists(folder / path)) lost.push_back(path);
  }
  return lost;
}

struct PartsTable {
  std::vector<std::string> first_column;  // names between backquotes
  std::vector<std::string> all;
};

/// The table of parts or files of a folder; empty where the README has none.
PartsTable read_parts(const std::string& prose) {
  PartsTable table;
  bool inside = false;
  for (const std::string& line : lines_of(prose)) {
    inside = line.starts_with("| part |") || line.starts_with("| file |") || (inside && line.starts_with("|"));
    if (!inside) continue;
    const auto first = texts_between(line.substr(0, line.find(" | ")), "`", '`');
    const auto all = texts_between(line, "`", '`');
    table.first_column.insert(table.first_column.end(), first.begin(), first.end());
    table.all.insert(table.all.end(), all.begin(), all.end());
  }
  return table;
}

/// Names in the first column that stand for no header, source or folder.
std::vector<std::string> lost_parts(const PartsTable& table, const fs::path& folder) {
  std::vector<std::string> lost;
  for (const std::string& part : table.first_column) {
    const std::string path = (folder / part).string();
    if (!fs::exists(path) && !fs::exists(path + ".h") && !fs::exists(path + ".cpp")) lost.push_back(part);
  }
  return lost;
}

/// Headers and folders that a table leaves out; nothing where there is no table.
std::vector<std::string> unnamed_parts(const PartsTable& table, const fs::path& folder) {
  std::vector<std::string> unnamed;
  if (table.all.empty()) return unnamed;
  const auto names = [&](const std::string& name) {
    return std::find(table.all.begin(), table.all.end(), name) != table.all.end();
  };
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& path = entry.path();
    if (!entry.is_directory() && path.extension() != ".h") continue;
    const std::string name = path.stem().string() + (entry.is_directory() ? "/" : "");
    if (!names(name) && !names(path.filename().string())) unnamed.push_back(name);
  }
  return unnamed;
}

/// Every README, and the pages that are written for who uses the program.
std::vector<fs::path> pages() {
  std::vector<fs::path> paths = {kRoot / "README.md", kRoot / "CONTRIBUTING.md", kRoot / "CHANGELOG.md",
                                 kRoot / "paper" / "paper.md"};
  for (const auto& entry : fs::directory_iterator(kRoot / "docs")) {
    if (entry.path().extension() == ".md") paths.push_back(entry.path());
  }
  for (const std::string& top : kTopFolders) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / top)) {
      if (entry.path().filename() == "README.md") paths.push_back(entry.path());
    }
  }
  return paths;
}

TEST(ReadmePaths, FindsWhatIsLost) {
  const std::string text =
      "\nSee `src/nowhere.h`, `src/core`, `myotact run`, ![p](no.png) and [w](https://x.org/y).\n```\n`src/in_block`\n"
      "```\n| part | what |\n|---|---|\n| `error` | `not/this` |\n| `text`, `txt` | |\n| `eror` | |\n\n| `other` | "
      "table |\n";
  EXPECT_EQ(lost_paths(prose_of(text), kRoot), (std::vector<std::string>{"no.png", "src/nowhere.h"}));
  const PartsTable table = read_parts(prose_of(text));
  EXPECT_EQ(lost_parts(table, kRoot / "src" / "core"), (std::vector<std::string>{"txt", "eror"}));
  const auto unnamed = unnamed_parts(table, kRoot / "src" / "core");
  EXPECT_EQ(std::count(unnamed.begin(), unnamed.end(), "log"), 1);
  EXPECT_EQ(std::count(unnamed.begin(), unnamed.end(), "error"), 0);
  EXPECT_TRUE(unnamed_parts(read_parts("no table"), kRoot / "src" / "core").empty());
}

TEST(ReadmePaths, EveryPageKeepsToWhatIsThere) {
  const auto paths = pages();
  EXPECT_GT(paths.size(), 10U);
  for (const fs::path& path : paths) {
    const std::string prose = prose_of(read_file(path));
    const fs::path folder = path.parent_path();
    for (const std::string& lost : lost_paths(prose, folder)) ADD_FAILURE() << path << ": " << lost;
    const PartsTable table = read_parts(prose);
    for (const std::string& part : lost_parts(table, folder)) ADD_FAILURE() << path << ": no part " << part;
    for (const std::string& part : unnamed_parts(table, folder)) ADD_FAILURE() << path << ": leaves out " << part;
  }
}

TEST(ReadmePaths, TheFirstPageIsReadInFiveMinutes) {
  std::istringstream words(read_file(kRoot / "README.md"));
  EXPECT_LE(std::distance(std::istream_iterator<std::string>(words), {}), 1500);
}

TEST(ReadmePaths, EveryPageOfDocsIsFoundInTheSite) {
  const std::string site = read_file(kRoot / "mkdocs.yml");
  for (const auto& entry : fs::directory_iterator(kRoot / "docs")) {
    const std::string page = entry.path().filename().string();
    if (!page.ends_with(".md")) continue;
    EXPECT_NE(site.find(": " + page + "\n"), std::string::npos) << "mkdocs.yml leaves out " << page;
  }
}

}  // namespace
}  // namespace myotact
