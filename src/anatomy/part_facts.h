#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace myotact::anatomy {

/// What a textbook states of a bone or muscle, in English; what is not known is empty. Bones have synonyms and region
/// alone.
struct PartFacts {
  std::vector<std::string> synonyms;
  std::string region;    // "arm"
  std::string function;  // "flexor of the elbow"
  std::string origin, insertion, action, innervation;
};

/// By the key of the part.
using FactsByKey = std::map<std::string, PartFacts>;

/// Reads a file like assets/canine/names.json. Throws Error NoInput or BadData.
FactsByKey load_part_facts(const std::filesystem::path& file);

/// Of the key, or nothing known.
const PartFacts& facts_of(const FactsByKey& facts, const std::string& key);

}  // namespace myotact::anatomy
