#include "view/ui/text.h"

#include <algorithm>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "core/data_folder.h"
#include "core/error.h"
#include "core/json_reader.h"
#include "core/text.h"

namespace myotact::view::ui {

namespace {

constexpr const char* kEnglish = "en";

std::filesystem::path languages_folder() {
  return data_folder() / "assets" / "languages";
}

struct Current {
  std::string language;
  Catalogue texts, english;
};

Current& current() {
  static Current texts = [] {
    Catalogue english = load_catalogue(kEnglish);
    return Current{kEnglish, english, english};
  }();
  return texts;
}

const std::string* find_text(std::string_view key) {
  for (const Catalogue* catalogue : {&current().texts, &current().english}) {
    const auto found = catalogue->find(key);
    if (found != catalogue->end()) return &found->second;
  }
  return nullptr;
}

void add_file(const std::filesystem::path& file, Catalogue& catalogue) {
  const nlohmann::json json = read_json(file);
  JsonObject texts{JsonValue(json, file.string())};
  for (const auto& [key, text] : texts.entries()) {
    if (!catalogue.emplace(key, text.string()).second) {
      throw text.error("another file of this language has this key too; rename one of them");
    }
  }
}

}  // namespace

std::vector<std::string> languages() {
  std::vector<std::string> codes;
  if (std::error_code ignored; !std::filesystem::is_directory(languages_folder(), ignored)) return codes;
  for (const auto& entry : std::filesystem::directory_iterator(languages_folder())) {
    if (entry.is_directory()) codes.push_back(entry.path().filename().string());
  }
  std::sort(codes.begin(), codes.end(), [](const std::string& a, const std::string& b) {
    return std::pair(a != kEnglish, a) < std::pair(b != kEnglish, b);
  });
  return codes;
}

Catalogue load_catalogue(const std::string& language) {
  const std::vector<std::string> known = languages();
  if (std::find(known.begin(), known.end(), language) == known.end()) {
    throw Error(ExitStatus::NoInput, fmt::format("no language \"{}\" in {}; there are: {}", language,
                                                 languages_folder().string(), join(known)));
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(languages_folder() / language)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());  // the file named in an error is the same everywhere
  Catalogue catalogue;
  for (const auto& file : files) add_file(file, catalogue);
  return catalogue;
}

void set_language(const std::string& language) {
  Catalogue texts = load_catalogue(language);
  current().texts = std::move(texts);
  current().language = language;
}

const std::string& language() {
  return current().language;
}

const Catalogue& english_texts() {
  return current().english;
}

const char* tr(std::string_view key) {
  if (const std::string* text = find_text(key)) return text->c_str();
  static std::map<std::string, std::string, std::less<>> missing;  // so that the pointer stays good
  return missing.emplace(key, key).first->second.c_str();
}

bool has_text(std::string_view key) {
  return find_text(key) != nullptr;
}

}  // namespace myotact::view::ui
