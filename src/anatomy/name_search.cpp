#include "anatomy/name_search.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "core/text.h"

namespace myotact::anatomy {

namespace {

constexpr std::size_t kLongestWord = 40;  // letters; what is longer is cut, so that no input makes a search slow

/// Words of small letters and digits; anything else parts them.
std::vector<std::string> plain_words(std::string_view text) {
  std::string plain = lower(text);
  for (char& c : plain) {
    if (!((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'))) c = ' ';
  }
  std::vector<std::string> words;
  for (const std::string_view word : words_of(plain)) words.emplace_back(word.substr(0, kLongestWord));
  return words;
}

int allowed_slips(std::size_t letters) {
  return letters >= 7 ? 2 : letters >= 4 ? 1 : 0;
}

/// 0: the word itself; 1: its beginning; above: with slips of the whole word, then of as much of it as was typed.
std::optional<int> word_rank(std::string_view typed, std::string_view word) {
  if (word == typed) return 0;
  if (word.starts_with(typed)) return 1;
  const int allowed = allowed_slips(typed.size());
  if (const int slips = typing_slips(typed, word); slips <= allowed) return 1 + slips;
  int fewest = allowed + 1;
  for (std::size_t length = typed.size() - 1; length <= typed.size() + 1 && length < word.size(); ++length) {
    fewest = std::min(fewest, typing_slips(typed, word.substr(0, length)));
  }
  if (fewest > allowed) return {};
  return 1 + allowed + fewest;
}

/// Every typed word must be one of the name's; the rank is the worst of them, better where the name starts with it.
std::optional<int> name_rank(const std::vector<std::string>& typed, const std::string& name) {
  const std::vector<std::string> words = plain_words(name);
  int worst = 0;
  for (const std::string& wanted : typed) {
    std::optional<int> best;
    for (std::size_t w = 0; w < words.size(); ++w) {
      if (const auto rank = word_rank(wanted, words[w])) {
        const int later = w == 0 ? 0 : 1;
        best = std::min(best.value_or(std::numeric_limits<int>::max()), 2 * *rank + later);
      }
    }
    if (!best) return {};
    worst = std::max(worst, *best);
  }
  return worst;
}

template <typename PartType>
std::optional<int> part_rank(const std::vector<std::string>& typed, const PartType& part, const PartFacts& facts) {
  std::vector<std::string> names = {part.name_en, part.name_la, part.key};
  names.insert(names.end(), facts.synonyms.begin(), facts.synonyms.end());
  std::optional<int> best;
  for (const std::string& name : names) {
    const auto rank = name_rank(typed, name);
    if (rank && (!best || *rank < *best)) best = rank;
  }
  return best;
}

}  // namespace

int typing_slips(std::string_view a, std::string_view b) {
  // Three rows of the table of optimal string alignment; row i holds the slips between the first i letters of a and b.
  std::vector<int> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

std::vector<FoundPart> find_parts(const Specimen& specimen, const FactsByKey& facts, std::string_view text) {
  const std::vector<std::string> typed = plain_words(text);
  std::vector<FoundPart> found;
  if (typed.empty()) return found;
  const auto look = [&](const auto& parts, bool bone) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto rank = part_rank(typed, parts[i], facts_of(facts, parts[i].key));
      if (rank) found.push_back({bone, static_cast<int>(i), *rank});
    }
  };
  look(specimen.muscles, false);
  look(specimen.bones, true);
  std::stable_sort(found.begin(), found.end(), [](const FoundPart& a, const FoundPart& b) { return a.rank < b.rank; });
  return found;
}

}  // namespace myotact::anatomy
