#include "view/ui/retold.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "view/ui/text.h"

namespace myotact::view::ui {

namespace {

constexpr std::string_view kPlace = "{}", kAfterName = ": ", kBetweenClauses = "; ";

std::vector<std::string> literals_of(std::string_view pattern) {
  std::vector<std::string> literals;
  for (std::size_t place; (place = pattern.find(kPlace)) != std::string_view::npos;) {
    literals.emplace_back(pattern.substr(0, place));
    pattern.remove_prefix(place + kPlace.size());
  }
  literals.emplace_back(pattern);
  return literals;
}

/// What stands at the places between the literals; empty where the text is another.
std::optional<std::vector<std::string>> values_in(std::string_view text, const std::vector<std::string>& literals) {
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
  // A place that begins a text does not swallow the names before it: they end before another beginning.
  const bool has_names = !values.empty() && values.front().find(kAfterName) != std::string::npos;
  return literals.front().empty() && has_names ? std::nullopt : std::optional(values);
}

std::string filled(std::string_view pattern, const std::vector<std::string>& values) {
  const std::vector<std::string> literals = literals_of(pattern);
  std::string text = literals.front();
  for (std::size_t i = 1; i < literals.size(); ++i) text += retold(values[i - 1]) + literals[i];
  return text;
}

struct Pattern {
  std::string key;
  std::vector<std::string> literals;
};

/// Of the English texts with such keys.
std::vector<Pattern> patterns_of(std::string_view begin_of_key) {
  std::vector<Pattern> all;
  const Catalogue& english = english_texts();
  for (auto it = english.lower_bound(begin_of_key); it != english.end() && it->first.starts_with(begin_of_key); ++it) {
    all.push_back({it->first, literals_of(it->second)});
  }
  return all;
}

/// Of the pattern whose places swallow least of what others name.
std::optional<std::string> told_by(const std::vector<Pattern>& patterns, const std::string& text) {
  const Pattern* best = nullptr;
  std::vector<std::string> best_values;
  std::size_t least = text.size() + 1;
  for (const Pattern& pattern : patterns) {
    auto values = values_in(text, pattern.literals);
    if (!values) continue;
    std::size_t swallowed = 0;
    for (const std::string& value : *values) swallowed += value.size();
    if (swallowed >= least) continue;
    least = swallowed;
    best = &pattern;
    best_values = std::move(*values);
  }
  if (best == nullptr) return std::nullopt;
  return filled(tr(best->key), best_values);
}

/// Of one text "said.*", or the hint of a driver.
std::optional<std::string> told_as_a_text(const std::string& text) {
  static const std::vector<Pattern> kSaid =
      patterns_of("said.");  // taken apart once: notices are told in every picture
  const std::string hint = "hint." + text;
  return has_text(hint) ? std::optional<std::string>(tr(hint)) : told_by(kSaid, text);
}

/// "step 3": of a file or a part, before what is wrong there.
std::string told_as_a_place(const std::string& text) {
  static const std::vector<Pattern> kPlaces = patterns_of("place.");
  return told_by(kPlaces, text).value_or(text);
}

/// Errors end without a full stop, until another sentence follows.
std::optional<std::string> told_with_or_without_stop(const std::string& text) {
  if (auto told = told_as_a_text(text)) return told;
  if (!text.ends_with('.')) return std::nullopt;
  const auto told = told_as_a_text(text.substr(0, text.size() - 1));
  return told ? std::optional(*told + ".") : std::nullopt;
}

std::vector<std::string> parts_of(const std::string& text, std::string_view between) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find(between, begin)) != std::string::npos; begin = end + between.size()) {
    parts.push_back(text.substr(begin, end - begin));
  }
  parts.push_back(text.substr(begin));
  return parts;
}

/// Also where files and places stand before it: "FILE: PLACE: TEXT".
std::optional<std::string> told_after_names(const std::string& text) {
  constexpr std::size_t kMostNames = 8;  // no text has more; bounds the time that any other takes
  const std::vector<std::string> parts = parts_of(text, kAfterName);
  std::string names;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < std::min(parts.size(), kMostNames); ++i) {
    if (const auto told = told_with_or_without_stop(text.substr(begin))) return names + *told;
    names += told_as_a_place(parts[i]);
    names += kAfterName;
    begin += parts[i].size() + kAfterName.size();
  }
  return std::nullopt;
}

/// Clause by clause, "CAUSE; REMEDY", where all are texts of their own; else a place at the end of one would swallow
/// those that follow.
std::optional<std::string> retold_sentence(const std::string& text) {
  std::string all;
  for (const std::string& clause : parts_of(text, kBetweenClauses)) {
    const auto told = told_after_names(clause);
    if (!told) return told_after_names(text);
    if (!all.empty()) all += kBetweenClauses;
    all += *told;
  }
  return all;
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
