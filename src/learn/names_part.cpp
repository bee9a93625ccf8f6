#include <algorithm>

#include "anatomy/name_search.h"
#include "core/text.h"
#include "learn/lesson_run.h"

namespace myotact::learn {

namespace {

/// Small words with single blanks between; what students leave out of a muscle's name is left out.
std::string plain_name(const std::string& text) {
  std::string letters;
  for (const char c : lower(text)) {
    const bool part_of_word = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 0x80;
    letters += part_of_word ? c : ' ';
  }
  std::vector<std::string> words;
  for (const std::string_view word : words_of(letters)) {
    if (word != "m" && word != "musculus" && word != "muscle") words.emplace_back(word);
  }
  return join(words, " ");
}

constexpr int kTooMany = 1000;

/// Slips by which two names of the same number of words differ, at most one in each word of five letters or more:
/// biceps is no slip of triceps.
int slips_between(const std::string& a, const std::string& b) {
  constexpr std::size_t kLongWord = 5;
  const auto words_a = words_of(a), words_b = words_of(b);
  if (words_a.size() != words_b.size()) return kTooMany;
  int slips = 0;
  for (std::size_t w = 0; w < words_a.size(); ++w) {
    const int here = anatomy::typing_slips(words_a[w], words_b[w]);
    if (here > (words_b[w].size() < kLongWord ? 0 : 1)) return kTooMany;
    slips += here;
  }
  return slips;
}

int slips_to(const std::string& typed, const std::vector<std::string>& names) {
  int fewest = kTooMany;
  for (const std::string& name : names) fewest = std::min(fewest, slips_between(typed, plain_name(name)));
  return fewest;
}

std::vector<std::string> names_of(const NameBook& book, const Part& part) {
  const std::string key = key_of(book.specimen, part);
  std::vector<std::string> names = anatomy::facts_of(book.facts, key).synonyms;
  names.push_back(key.substr(key.find('.') + 1));
  const auto add = [&](const auto& item) {
    names.push_back(item.name_la);
    names.push_back(item.name_en);
  };
  if (part.muscle >= 0) {
    add(book.specimen.muscles[static_cast<std::size_t>(part.muscle)]);
  } else {
    add(book.specimen.bones[static_cast<std::size_t>(part.bone)]);
  }
  return names;
}

}  // namespace

bool names_part(const std::string& text, const Part& part, const NameBook& book) {
  constexpr std::size_t kLongest = 100;  // no name is longer, and comparing is quadratic
  const std::string typed = plain_name(text.substr(0, kLongest));
  if (typed.empty()) return false;
  std::vector<std::string> names = names_of(book, part);
  names.insert(names.end(), book.accept.begin(), book.accept.end());
  const int slips = slips_to(typed, names);
  if (slips == 0) return true;
  if (slips == kTooMany) return false;
  // A slip must not make one muscle's name out of another's: tibialis cranialis, tibialis caudalis.
  const auto nearer = [&](const Part& other) {
    return other != part && slips_to(typed, names_of(book, other)) <= slips;
  };
  for (int m = 0; m < static_cast<int>(book.specimen.muscles.size()); ++m) {
    if (nearer({m, -1})) return false;
  }
  for (int b = 0; b < static_cast<int>(book.specimen.bones.size()); ++b) {
    if (nearer({-1, b})) return false;
  }
  return true;
}

}  // namespace myotact::learn
