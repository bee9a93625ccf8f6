#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "anatomy/part_facts.h"
#include "anatomy/specimen.h"

namespace myotact::anatomy {

/// A bone or muscle that a search found.
struct FoundPart {
  bool bone = false;
  int index = -1;  // as in the specimen
  int rank = 0;    // 0 the best: the whole name, its beginning, that of a word, with slips of typing
};

/// Finds parts by key, Latin name, English name and synonyms; capitals, accents of ASCII kind and word order do not
/// matter, a word of four letters may hold one slip of typing (a letter wrong, missing, too many or two swapped), one
/// of seven two. The best first, equals in the specimen's order. Nothing for a text without a letter.
std::vector<FoundPart> find_parts(const Specimen& specimen, const FactsByKey& facts, std::string_view text);

/// Slips of typing between two words: letters wrong, missing or too many, neighbours swapped (optimal string
/// alignment).
int typing_slips(std::string_view a, std::string_view b);

}  // namespace myotact::anatomy
