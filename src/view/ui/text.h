#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace myotact::view::ui {

/// Texts of the interface by key: what assets/languages/CODE/*.json hold, one flat object of strings a file.
using Catalogue = std::map<std::string, std::string, std::less<>>;

/// Codes of the languages that are there, "en" first.
std::vector<std::string> languages();

/// Throws Error NoInput for a language that is not there (names those that are), BadData for a file with an error or a
/// key that another file of the language has too.
Catalogue load_catalogue(const std::string& language);

/// From now on texts are those of this language; a key that it lacks is taken from English. Throws as load_catalogue().
/// Texts belong to the thread that draws.
void set_language(const std::string& language);
const std::string& language();

/// What texts of other languages stand for.
const Catalogue& english_texts();

/// The text of a key, valid until set_language(); the key itself where there is none. English before set_language().
const char* tr(std::string_view key);
bool has_text(std::string_view key);

/// The text of a key with its places ("{}", "{:.1f}") filled in; unfilled where the text does not fit the values.
template <typename... Values>
std::string tr(std::string_view key, const Values&... values) {
  const char* text = tr(key);
  try {
    return fmt::format(fmt::runtime(text), values...);
  } catch (const fmt::format_error&) {
    return text;
  }
}

}  // namespace myotact::view::ui
