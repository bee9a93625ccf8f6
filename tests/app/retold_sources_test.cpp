// What the sources say to a person at run time has a text in the languages of the window: each sentence in a literal of
// the files below, or each clause of it, stands in a text "said.*" or "hint.*".

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "core/file.h"
#include "support/source_folder.h"
#include "view/ui/text.h"

namespace myotact::view::ui {
namespace {

namespace fs = std::filesystem;

bool is_small(char c) {
  return c >= 'a' && c <= 'z';
}

/// Two words beside each other, of which one is more than a letter. Keys, paths and formats of numbers have none.
bool is_sentence(std::string_view text) {
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (text[i] != ' ' || !is_small(text[i - 1]) || !is_small(text[i + 1])) continue;
    if ((i > 1 && is_small(text[i - 2])) || (i + 2 < text.size() && is_small(text[i + 2]))) return true;
  }
  return false;
}

/// The literals of a source in which somebody is spoken to. What goes to the terminal or names a thread is left out.
class Literals {
 public:
  explicit Literals(std::string_view source) : rest_(source) {
    while (!rest_.empty()) step();
    end();
  }
  const std::vector<std::string>& found() const { return found_; }

 private:
  void step() {
    constexpr std::array<std::string_view, 5> kNotShown = {"spdlog::", "static_assert(", "name_this_thread(",
                                                           "std::fprintf(", "throw std::"};
    if (rest_.starts_with("//")) return skip(rest_.find('\n'));
    if (rest_.starts_with("'\"'")) return skip(3);
    if (rest_.starts_with("R\"")) return skip_raw();
    if (rest_.front() == '"') return take();
    for (const std::string_view word : kNotShown) skips_ = skips_ || rest_.starts_with(word);
    if (std::isspace(static_cast<unsigned char>(rest_.front())) == 0) end();
    if (rest_.front() == ';') skips_ = false;
    skip(1);
  }

  void skip(std::size_t count) { rest_.remove_prefix(std::min(count, rest_.size())); }

  void skip_raw() {
    const std::string delimiter = ")" + std::string(rest_.substr(2, rest_.find('(') - 2)) + "\"";
    const std::size_t at = rest_.find(delimiter);
    skip(at == std::string_view::npos ? at : at + delimiter.size());
  }

  /// Literals that stand beside each other are one.
  void take() {
    std::size_t length = 1;
    while (length < rest_.size() && rest_[length] != '"') length += rest_[length] == '\\' ? 2 : 1;
    if (!skips_) literal_ += rest_.substr(1, length - 1);
    skip(length + 1);
  }

  void end() {
    if (is_sentence(literal_) && literal_.find("\\n") == std::string::npos) found_.push_back(literal_);
    literal_.clear();
  }

  std::string_view rest_;
  std::string literal_;
  bool skips_ = false;
  std::vector<std::string> found_;
};

/// As texts have it: quotes without backslashes, places without what is in them.
std::string as_text(const std::string& literal) {
  std::string text;
  for (std::size_t i = 0; i < literal.size(); ++i) {
    if (literal[i] == '\\') continue;
    if (literal[i] == '{' && !text.ends_with("{}")) text += "{}";  // two values beside each other are one place
    if (literal[i] == '{')
      i = std::min(literal.find('}', i), literal.size());
    else
      text += literal[i];
  }
  return text;
}

std::vector<std::string> pieces_of(const std::string& text, std::string_view between) {
  std::vector<std::string> pieces;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find(between, begin)) != std::string::npos; begin = end + between.size()) {
    pieces.push_back(text.substr(begin, end - begin));
  }
  pieces.push_back(text.substr(begin));
  return pieces;
}

/// Without the names of file and place before it, and the signs and the place at its ends.
std::string bare(std::string piece) {
  for (std::size_t at; (at = piece.find(": ")) != std::string::npos && !is_sentence(piece.substr(0, at));) {
    piece.erase(0, at + 2);
  }
  constexpr std::string_view kSigns = " .,:;";
  piece.erase(0, std::min(piece.find_first_not_of(kSigns), piece.size()));
  if (piece.ends_with("{}")) piece.resize(piece.size() - 2);
  while (!piece.empty() && kSigns.find(piece.back()) != std::string_view::npos) piece.pop_back();
  return piece;
}

/// Texts that are no sentences: names of devices, which are the same in all languages.
constexpr std::array<std::string_view, 2> kNames = {"Force Dimension omega, delta, sigma, lambda",
                                                    "SpaceNavigator for Notebooks"};

class Texts {
  const std::regex kRange{" \\.\\. "};  // "1 .. 2" ends no sentence

 public:
  Texts() {
    for (const auto& [key, text] : english_texts()) {
      if (key.starts_with("said.") || key.starts_with("hint.") || key.starts_with("place."))
        texts_.push_back(std::regex_replace(as_text(text), kRange, " to "));
    }
    texts_.insert(texts_.end(), kNames.begin(), kNames.end());
  }
  bool hold(const std::string& piece) const {
    return std::any_of(texts_.begin(), texts_.end(), [&](const auto& t) { return t.find(piece) != std::string::npos; });
  }
  /// What of a literal is in none of them.
  std::vector<std::string> lacking(const std::string& literal) const {
    std::vector<std::string> lacking;
    const std::string text = std::regex_replace(as_text(literal), kRange, " to ");
    for (const std::string& sentence : pieces_of(text, ". ")) {
      if (hold(bare(sentence))) continue;
      for (const std::string& clause : pieces_of(sentence, "; ")) {
        if (!hold(bare(clause))) lacking.push_back(clause);
      }
    }
    return lacking;
  }

 private:
  std::vector<std::string> texts_;
};

/// Whose errors and notices a window can show: all of these folders, but for what speaks to other programs only.
std::vector<fs::path> speaking_sources() {
  const std::vector<std::string> folders = {"src/scene",      "src/learn",        "src/anatomy",    "src/net",
                                            "src/remote",     "src/device",       "src/simulation", "src/haptics",
                                            "src/view/input", "src/view/session", "src/view/sound"};
  const std::vector<std::string> files = {"core/file",
                                          "core/user_folder",
                                          "core/json_reader",
                                          "core/data_folder",
                                          "view/ui/text",
                                          "geometry/words",
                                          "geometry/ply",
                                          "geometry/ply_header",
                                          "geometry/vtk",
                                          "app/view",
                                          "geometry/scalars",
                                          "geometry/vtk_surface",
                                          "geometry/read_surface",
                                          "app/mirror_stage",
                                          "app/hands",
                                          "view/pictures/film",
                                          "app/live_stage",
                                          "geometry/read_tet_mesh",
                                          "app/replay_stage",
                                          "app/stage",
                                          "app/network_options",
                                          "app/equipment",
                                          "app/camera_device",
                                          "view/pictures/video_pipe",
                                          "geometry/surface_builder"};
  const std::vector<std::string> to_programs = {
      "websocket_listener.cpp", "web_files.cpp",       "picture_encoder.cpp", "token.cpp",
      "lockstep_hand.cpp",      "lockstep_server.cpp", "classroom.cpp"};
  std::vector<fs::path> sources;
  for (const std::string& folder : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(source_folder()) / folder)) {
      const fs::path& path = entry.path();
      const bool left_out =
          std::find(to_programs.begin(), to_programs.end(), path.filename().string()) != to_programs.end();
      if (path.extension() == ".cpp" && !left_out) sources.push_back(path);
    }
  }
  for (const std::string& file : files) sources.push_back(fs::path(source_folder()) / "src" / (file + ".cpp"));
  return sources;
}

TEST(RetoldSources, HaveATextForEachSentence) {
  const Texts texts;
  int sentences = 0;
  for (const fs::path& path : speaking_sources()) {
    const std::string source = read_file(path);
    const Literals literals(source);
    for (const std::string& literal : literals.found()) {
      ++sentences;
      for (const std::string& piece : texts.lacking(literal)) {
        ADD_FAILURE() << path.string() << ": add a text \"said.*\" to each of assets/languages for: " << piece;
      }
    }
  }
  EXPECT_GT(sentences, 350);
}

TEST(RetoldSources, ANewSentenceIsFound) {
  const Texts texts;
  const Literals literals(
      "f(\"a.json: is {}; must be a \"\n  \"horse\"); // \"no such thing\"\nspdlog::info(\"it goes; on\");");
  ASSERT_EQ(literals.found(), std::vector<std::string>{"a.json: is {}; must be a horse"});
  EXPECT_EQ(texts.lacking(literals.found()[0]), std::vector<std::string>{"must be a horse"});
  EXPECT_TRUE(texts.lacking("{}: is {:.2f}; must be a number").empty());
}

}  // namespace
}  // namespace myotact::view::ui
