#include "prepare/guess/part_names.h"

#include <algorithm>
#include <array>
#include <set>

#include "anatomy/name_search.h"
#include "core/text.h"

namespace myotact::prepare {

namespace {

/// Keys are names of files, too (anatomy/find_defect.cpp).
constexpr std::size_t kLongestKey = 100;
/// Of two words as parts of the longer one: more slips than that are another word.
constexpr double kMostSlips = 0.4;
constexpr std::size_t kMostSuggestions = 3;

const std::set<std::string> kSides = {"l",      "r",        "left", "right", "sin",   "dex",   "sinister",
                                      "dexter", "sinistra", "li",   "re",    "links", "rechts"};
const std::set<std::string> kKindWords = {"muskel", "knochen", "m", "musculus", "muscle", "musc", "os", "bone", "ossa"};
const std::set<std::string> kBoneWords = {
    "knochen", "os",       "ossa",      "bone",    "bones",  "femur",   "tibia",     "fibula",
    "humerus", "radius",   "ulna",      "scapula", "pelvis", "patella", "calcaneus", "calcaneum",
    "talus",   "carpus",   "tarsus",    "sacrum",  "skull",  "cranium", "mandible",  "mandibula",
    "rib",     "ribs",     "costa",     "sternum", "ilium",  "ischium", "coxae",     "sesamoid",
    "fabella", "clavicle", "clavicula", "manus",   "pes",    "kneecap", "astragalus"};
const std::array<const char*, 4> kBoneBeginnings = {"metacarp", "metatars", "phalan", "vertebra"};
const std::set<std::string> kMuscleWords = {
    "muskel",        "m",         "musculus",  "muscle",     "muscles",        "musc",
    "flexor",        "extensor",  "abductor",  "adductor",   "rotator",        "levator",
    "tensor",        "supinator", "pronator",  "biceps",     "triceps",        "quadriceps",
    "vastus",        "gluteus",   "glutaeus",  "rectus",     "semitendinosus", "semimembranosus",
    "gastrocnemius", "soleus",    "popliteus", "brachialis", "deltoid",        "deltoideus",
    "pectoralis",    "trapezius", "sartorius", "gracilis",   "tibialis",       "peroneus",
    "fibularis",     "belly",     "tendon"};

std::vector<std::string> plain_words(std::string_view name) {
  std::string plain = lower(name);
  for (char& c : plain) {
    if (!((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'))) c = ' ';
  }
  std::vector<std::string> words;
  for (const std::string_view word : words_of(plain)) words.emplace_back(word);
  return words;
}

/// Without side and kind, in one piece.
std::string bare(std::string_view name) {
  std::string text;
  for (const std::string& word : plain_words(name)) {
    if (!kSides.contains(word) && !kKindWords.contains(word)) text += word;
  }
  return text.substr(0, kLongestKey);
}

std::vector<std::string> all_names(const NamedPart& part) {
  std::vector<std::string> names = {part.key, part.name_la, part.name_en};
  names.insert(names.end(), part.synonyms.begin(), part.synonyms.end());
  // "fore.flexor_digitorum_profundus": the limb is no part of the name.
  if (const std::size_t point = part.key.find('.'); point != std::string::npos) {
    names.push_back(part.key.substr(point + 1));
  }
  return names;
}

}  // namespace

std::string part_key(std::string_view name) {
  std::string key;
  for (const std::string& word : plain_words(name)) key += (key.empty() ? "" : "_") + word;
  return key.empty() ? "part" : key.substr(0, kLongestKey);
}

LikelyKind kind_by_name(std::string_view name) {
  const std::vector<std::string> words = plain_words(name);
  const auto is_one_of = [&](const std::set<std::string>& set) {
    return std::any_of(words.begin(), words.end(), [&](const std::string& word) { return set.contains(word); });
  };
  if (is_one_of(kMuscleWords)) return LikelyKind::Muscle;  // "flexor carpi radialis", "tendon of the patella"
  if (is_one_of(kBoneWords)) return LikelyKind::Bone;
  for (const std::string& word : words) {
    for (const char* beginning : kBoneBeginnings) {
      if (word.starts_with(beginning)) return LikelyKind::Bone;
    }
  }
  return LikelyKind::Unknown;
}

std::optional<std::size_t> find_known(std::string_view name, const KnownParts& known) {
  const std::string wanted = bare(name);
  if (wanted.empty()) return {};
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const std::vector<std::string> names = all_names(known[i]);
    if (std::none_of(names.begin(), names.end(), [&](const std::string& n) { return bare(n) == wanted; })) continue;
    if (found) return {};
    found = i;
  }
  return found;
}

std::vector<std::string> similar_parts(std::string_view name, const KnownParts& known) {
  const std::string wanted = bare(name);
  std::vector<std::pair<double, std::string>> ranked;
  for (const NamedPart& part : known) {
    double least = 1.0;
    for (const std::string& other : all_names(part)) {
      const std::string there = bare(other);
      const double longest = static_cast<double>(std::max<std::size_t>(1, std::max(wanted.size(), there.size())));
      least = std::min(least, anatomy::typing_slips(wanted, there) / longest);
      constexpr std::size_t kTelling = 4;  // letters; shorter ones are in too many names
      const bool holds = wanted.size() >= kTelling && there.find(wanted) != std::string::npos;
      if (holds) least = std::min(least, 0.5 * (1.0 - static_cast<double>(wanted.size()) / longest));
    }
    if (least <= kMostSlips) ranked.emplace_back(least, part.key);
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> keys;
  for (const auto& [slips, key] : ranked) {
    if (keys.size() < kMostSuggestions) keys.push_back(key);
  }
  return keys;
}

std::string spoken_name(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

}  // namespace myotact::prepare
