#include <algorithm>
#include <numeric>

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

/// Letters to be put in, taken out or changed (Levenshtein 1966).
std::size_t edits_between(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}

constexpr std::size_t kTooMany = 1000;

/// Slips by which two names of the same number of words differ, at most one in each word of five letters or more:
/// biceps is no slip of triceps.
std::size_t slips_between(const std::string& a, const std::string& b) {
  constexpr std::size_t kLongWord = 5;
  const auto words_a = words_of(a), words_b = words_of(b);
  if (words_a.size() != words_b.size()) return kTooMany;
  std::size_t slips = 0;
  for (std::size_t w = 0; w < words_a.size(); ++w) {
    const std::size_t edits = edits_between(std::string(words_a[w]), std::string(words_b[w]));
    if (edits > (words_b[w].size() < kLongWord ? 0u : 1u)) return kTooMany;
    slips += edits;
  }
  return slips;
}

std::size_t slips_to(const std::string& typed, const std::vector<std::string>& names) {
  std::size_t fewest = kTooMany;
  for (const std::string& name : names) fewest = std::min(fewest, slips_between(typed, plain_name(name)));
  return fewest;
}

std::vector<std::string> names_of(const anatomy::Specimen& specimen, const Part& part) {
  if (part.muscle >= 0) {
    const anatomy::Muscle& muscle = specimen.muscles[static_cast<std::size_t>(part.muscle)];
    return {muscle.key.substr(muscle.key.find('.') + 1), muscle.name_la, muscle.name_en};
  }
  const anatomy::Bone& bone = specimen.bones[static_cast<std::size_t>(part.bone)];
  return {bone.key, bone.name_la, bone.name_en};
}

}  // namespace

bool names_part(const std::string& text, const Part& part, const anatomy::Specimen& specimen,
                const std::vector<std::string>& accept) {
  constexpr std::size_t kLongest = 100;  // no name is longer, and comparing is quadratic
  const std::string typed = plain_name(text.substr(0, kLongest));
  if (typed.empty()) return false;
  std::vector<std::string> names = names_of(specimen, part);
  names.insert(names.end(), accept.begin(), accept.end());
  const std::size_t slips = slips_to(typed, names);
  if (slips == 0) return true;
  if (slips == kTooMany) return false;
  // A slip must not make one muscle's name out of another's: tibialis cranialis, tibialis caudalis.
  const auto nearer = [&](const Part& other) {
    return other != part && slips_to(typed, names_of(specimen, other)) <= slips;
  };
  for (int m = 0; m < static_cast<int>(specimen.muscles.size()); ++m) {
    if (nearer({m, -1})) return false;
  }
  for (int b = 0; b < static_cast<int>(specimen.bones.size()); ++b) {
    if (nearer({-1, b})) return false;
  }
  return true;
}

}  // namespace myotact::learn
