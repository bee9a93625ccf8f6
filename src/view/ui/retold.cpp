#include "view/ui/retold.h"

#include <vector>

#include "view/ui/text.h"

namespace myotact::view::ui {

namespace {

constexpr std::string_view kPlace = "{}", kSaid = "said.";

std::vector<std::string> literals_of(std::string_view pattern) {
  std::vector<std::string> literals;
  for (std::size_t place; (place = pattern.find(kPlace)) != std::string_view::npos;) {
    literals.emplace_back(pattern.substr(0, place));
    pattern.remove_prefix(place + kPlace.size());
  }
  literals.emplace_back(pattern);
  return literals;
}

/// What stands at the places of the pattern; empty where the text is another.
std::optional<std::vector<std::string>> values_in(std::string_view text, std::string_view pattern) {
  const std::vector<std::string> literals = literals_of(pattern);
  if (!text.starts_with(literals.front())) return std::nullopt;
  text.remove_prefix(literals.front().size());
  std::vector<std::string> values;
  for (std::size_t i = 1; i < literals.size(); ++i) {
    const bool last = i + 1 == literals.size();
    if (last && !text.ends_with(literals[i])) return std::nullopt;
    const std::size_t end = last ? text.size() - literals[i].size() : text.find(literals[i]);
    if (end == std::string_view::npos) return std::nullopt;
    values.emplace_back(text.substr(0, end));
    text.remove_prefix(end + literals[i].size());
  }
  if (!text.empty()) return std::nullopt;
  return values;
}

std::string filled(std::string_view pattern, const std::vector<std::string>& values) {
  const std::vector<std::string> literals = literals_of(pattern);
  std::string text = literals.front();
  for (std::size_t i = 1; i < literals.size(); ++i) text += retold(values[i - 1]) + literals[i];
  return text;
}

/// Of one text "said.*"; of several that fit, the one whose places swallow least of what others name.
std::optional<std::string> retold_sentence(const std::string& text) {
  std::optional<std::string> best;
  std::size_t least = text.size() + 1;
  const Catalogue& english = english_texts();
  for (auto it = english.lower_bound(kSaid); it != english.end() && it->first.starts_with(kSaid); ++it) {
    const auto values = values_in(text, it->second);
    if (!values) continue;
    std::size_t swallowed = 0;
    for (const std::string& value : *values) swallowed += value.size();
    if (swallowed >= least) continue;
    least = swallowed;
    best = filled(tr(it->first), *values);
  }
  return best;
}

/// Sentences with the blanks between them: each ends where a full stop is followed by a blank or by nothing.
std::vector<std::string> sentences_of(const std::string& text) {
  std::vector<std::string> sentences;
  std::size_t begin = 0;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    if (text[i] != '.' || (text[i + 1] != ' ' && text[i + 1] != '\n')) continue;
    if (i > 0 && text[i - 1] == '.') continue;  // of a range: 1 .. 2
    sentences.push_back(text.substr(begin, i + 1 - begin));
    sentences.push_back(text.substr(i + 1, 1));
    begin = i + 2;
  }
  sentences.push_back(text.substr(begin));
  return sentences;
}

std::string retold_by_sentences(const std::string& text, bool& whole) {
  std::string all;
  for (const std::string& sentence : sentences_of(text)) {
    const bool is_blank = sentence == " " || sentence == "\n" || sentence.empty();
    const std::optional<std::string> told = is_blank ? sentence : retold_sentence(sentence);
    whole = whole && told.has_value();
    all += told.value_or(sentence);
  }
  return all;
}

}  // namespace

std::string retold(const std::string& text) {
  if (const auto told = retold_whole(text)) return *told;
  bool whole = true;
  return retold_by_sentences(text, whole);
}

/// Sentence by sentence first: else a place at the end of one would swallow all that follow. Some texts are of several.
std::optional<std::string> retold_whole(const std::string& text) {
  bool whole = true;
  const std::string told = retold_by_sentences(text, whole);
  return whole ? std::optional(told) : retold_sentence(text);
}

}  // namespace myotact::view::ui
