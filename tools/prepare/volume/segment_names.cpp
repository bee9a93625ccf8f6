#include "prepare/volume/segment_names.h"

#include <algorithm>
#include <set>

#include "core/text.h"

namespace myotact::prepare {

namespace {

using Words = std::set<std::string, std::less<>>;

constexpr std::size_t kMostLetters = 400;
constexpr std::size_t kMostWords = 40;

const Words kMuscleWords = {"m", "mm", "musc", "musculus", "musculi", "muscle", "muscles"};
const Words kLeftWords = {"left", "l", "lt", "sin", "sinister", "sinistra", "sinistrum"};
const Words kRightWords = {"right", "r", "rt", "dex", "dexter", "dextra", "dextrum"};
const Words kFillers = {"the", "of"};
const Words kBoneWords = {"os", "ossa", "ossis", "bone", "bones"};

/// Muscles are also named by what they do, their heads and their shape.
const Words kMuscleNames = {
    "abductor",  "adductor",      "anconeus",      "biceps",        "brachialis",      "deltoid",        "deltoideus",
    "extensor",  "flexor",        "gastrocnemius", "gemelli",       "gluteal",         "gluteus",        "gracilis",
    "hamstring", "iliacus",       "iliopsoas",     "infraspinatus", "latissimus",      "levator",        "obturator",
    "pectoral",  "pectoralis",    "pectineus",     "popliteus",     "pronator",        "psoas",          "quadriceps",
    "rectus",    "rhomboid",      "rhomboideus",   "sartorius",     "semimembranosus", "semitendinosus", "serratus",
    "soleus",    "subscapularis", "supinator",     "supraspinatus", "tensor",          "teres",          "tibialis",
    "trapezius", "triceps",       "vastus"};
const Words kBoneNames = {
    "acetabulum", "astragalus", "calcaneus",   "carpal",     "carpals",   "carpus",  "clavicle",   "clavicula",
    "costa",      "costae",     "coccyx",      "cranium",    "fabella",   "femur",   "fibula",     "humerus",
    "ilium",      "ischium",    "kneecap",     "mandible",   "mandibula", "manus",   "metacarpal", "metacarpals",
    "metacarpus", "metatarsal", "metatarsals", "metatarsus", "olecranon", "patella", "pelvis",     "pes",
    "phalanges",  "phalanx",    "pubis",       "radius",     "rib",       "ribs",    "sacrum",     "scapula",
    "sesamoid",   "sesamoids",  "skeleton",    "skull",      "sternum",   "talus",   "tarsal",     "tarsals",
    "tarsus",     "tibia",      "ulna",        "vertebra",   "vertebrae"};
const Words kOtherNames = {"air",    "artery", "arteria",  "background", "blood",  "bursa",    "cartilage", "cartilago",
                           "fascia", "fat",    "ligament", "ligamentum", "marrow", "meniscus", "nerve",     "nervus",
                           "skin",   "table",  "tendo",    "tendon",     "vein",   "vena",     "vessel",    "vessels"};

char lowered(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool is_capital(char c) {
  return c >= 'A' && c <= 'Z';
}

bool is_small(char c) {
  return c >= 'a' && c <= 'z';
}

/// Words of small letters and digits; a capital after a small letter begins one, too.
std::vector<std::string> words_in(std::string_view name) {
  name = name.substr(0, kMostLetters);
  std::string spaced;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (i > 0 && is_capital(name[i]) && is_small(name[i - 1])) spaced += ' ';
    const char c = lowered(name[i]);
    const bool kept = is_small(c) || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 0x80;
    spaced += kept ? c : ' ';
  }
  std::vector<std::string> words;
  for (const std::string_view word : words_of(spaced)) words.emplace_back(word);
  words.resize(std::min(words.size(), kMostWords));
  return words;
}

bool any_of(const std::vector<std::string>& words, const Words& known) {
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) { return known.contains(word); });
}

std::string sorted_without(std::vector<std::string> words, bool without_bone) {
  const auto left_out = [&](const std::string& word) {
    return kMuscleWords.contains(word) || kLeftWords.contains(word) || kRightWords.contains(word) ||
           kFillers.contains(word) || (without_bone && kBoneWords.contains(word));
  };
  words.erase(std::remove_if(words.begin(), words.end(), left_out), words.end());
  std::sort(words.begin(), words.end());
  return join(words, " ");
}

}  // namespace

std::string text_of(PartKind kind) {
  return kind == PartKind::Bone ? "bone" : kind == PartKind::Muscle ? "muscle" : "ignore";
}

std::string plain_name(std::string_view name) {
  return sorted_without(words_in(name), false);
}

std::string name_without_bone(std::string_view name) {
  return sorted_without(words_in(name), true);
}

std::string side_in(std::string_view name) {
  const std::vector<std::string> words = words_in(name);
  const bool left = any_of(words, kLeftWords), right = any_of(words, kRightWords);
  return left == right ? "" : left ? "left" : "right";
}

std::optional<PartKind> kind_in(std::string_view name) {
  const std::vector<std::string> words = words_in(name);
  if (any_of(words, kOtherNames) && !any_of(words, {"tensor"})) return PartKind::Ignore;  // tensor fasciae latae
  if (any_of(words, kMuscleWords) || any_of(words, kMuscleNames)) return PartKind::Muscle;
  if (any_of(words, kBoneWords) || any_of(words, kBoneNames)) return PartKind::Bone;
  return {};
}

std::string key_from(std::string_view name) {
  std::string key;
  for (const std::string& word : words_in(name)) {
    std::string kept;
    for (const char c : word) {
      if (static_cast<unsigned char>(c) < 0x80) kept += c;
    }
    if (kept.empty() || kMuscleWords.contains(word)) continue;
    key += (key.empty() ? "" : "_") + kept;
  }
  return key;
}

}  // namespace myotact::prepare
