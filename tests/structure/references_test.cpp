#include <algorithm>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/file.h"
#include "support/source_folder.h"

// A source that a comment cites can be found: no number of a document that readers do not have, and every "Author year"
// stands in docs/references.md.

namespace myotact {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = source_folder();

struct Citation {
  std::string author;
  std::string year;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t start = 0; start < text.size(); start += lines.back().size() + 1) {
    lines.push_back(text.substr(start, text.find('\n', start) - start));
  }
  return lines;
}

/// What a line cites of documents that are not here; empty: nothing.
std::string lost_document(const std::string& line) {
  static const std::regex lost(R"(\b[Rr]eferences? [0-9]|\((the )?references?:|\bFORMATS\b|\bDESIGN\b)");
  std::smatch found;
  return std::regex_search(line, found, lost) ? found.str() : "";
}

/// "Name 1995", "Name et al. 1995", "Name (1995)" in the comment of a line.
std::vector<Citation> citations_of(const std::string& line) {
  static const std::regex cited(
      R"(\b([A-Z][A-Za-z-]+)(?:,? et al\.?| and others)?,? \(?((?:19|20)[0-9][0-9])(?![0-9.]))");
  std::vector<Citation> citations;
  const std::size_t comment = line.find("//");
  if (comment == std::string::npos) return citations;
  const std::string text = line.substr(comment);
  for (std::sregex_iterator it(text.begin(), text.end(), cited), end; it != end; ++it) {
    citations.push_back({(*it)[1], (*it)[2]});
  }
  return citations;
}

bool is_listed(const Citation& citation, const std::vector<std::string>& entries) {
  return std::any_of(entries.begin(), entries.end(), [&](const std::string& entry) {
    return entry.starts_with("- **") && entry.find(citation.author) != std::string::npos &&
           entry.find(citation.year) != std::string::npos;
  });
}

bool is_read(const fs::path& path) {
  static const std::vector<std::string> read = {".h", ".cpp", ".py", ".cs", ".md", ".json", ".glsl", ".cmake", ".txt"};
  return path.filename() != "references_test.cpp" &&
         std::find(read.begin(), read.end(), path.extension().string()) != read.end();
}

TEST(References, FindsWhatIsLost) {
  EXPECT_NE(lost_document("x = 1.0;  // a share (reference 2.6)"), "");
  EXPECT_NE(lost_document("/// Reference 3: a hand"), "");
  EXPECT_NE(lost_document("/// (reference: 0.5-3)"), "");
  EXPECT_EQ(lost_document("/// All references outlive it. A reference frame."), "");
  const std::vector<Citation> found =
      citations_of("f();  // as Hannaford and Ryu 2002, De Groote et al. (2016); 2000 N");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].author + found[0].year + found[1].author + found[1].year, "Ryu2002Groote2016");
  EXPECT_TRUE(citations_of("Ryu 2002").empty());  // no comment
  EXPECT_TRUE(is_listed({"Ryu", "2002"}, {"- **Hannaford and Ryu 2002**: passivity"}));
  EXPECT_FALSE(is_listed({"Ryu", "2003"}, {"- **Hannaford and Ryu 2002**: passivity"}));
  EXPECT_FALSE(is_listed({"Ryu", "2002"}, {"Ryu 2002"}));
}

TEST(References, EverySourceThatAFileCitesIsThere) {
  const std::vector<std::string> entries = lines_of(read_file(kRoot / "docs" / "references.md"));
  int citations = 0;
  for (const char* top : {"src", "tools", "tests", "assets", "shaders"}) {
    for (const auto& file : fs::recursive_directory_iterator(kRoot / top)) {
      if (!file.is_regular_file() || !is_read(file.path())) continue;
      for (const std::string& line : lines_of(read_file(file.path()))) {
        if (line.size() > 2000) continue;  // data
        EXPECT_EQ(lost_document(line), "") << file.path() << ": name author and year, or the file of results: " << line;
        for (const Citation& citation : citations_of(line)) {
          ++citations;
          EXPECT_TRUE(is_listed(citation, entries))
              << file.path() << ": " << citation.author << " " << citation.year << " is not in docs/references.md";
        }
      }
    }
  }
  EXPECT_GT(citations, 30);
}

}  // namespace
}  // namespace myotact
