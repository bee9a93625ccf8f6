#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

// What can be told from the name that somebody gave a part.

namespace myotact::prepare {

/// A part that the program has names for, and every word for it.
struct NamedPart {
  std::string key, name_la, name_en;
  bool bone = false;
  std::vector<std::string> synonyms;
};
using KnownParts = std::vector<NamedPart>;

/// A name as a legal key: small letters and digits, anything else as one "_"; "part" where nothing is left.
std::string part_key(std::string_view name);

enum class LikelyKind { Bone, Muscle, Unknown };

/// By words that only bones have ("os", "femur", "phalanx") or only muscles ("musculus", "flexor").
LikelyKind kind_by_name(std::string_view name);

/// The index of the part that the name means: its key, Latin or English name or a synonym, whatever the capitals and
/// signs between, with or without side ("left", "L", "sin"), "musculus", "os", "muscle", "bone". Nothing when there is
/// none, or more than one ("triceps").
std::optional<std::size_t> find_known(std::string_view name, const KnownParts& known);

/// Keys of the known parts with the most similar names, at most three, the best first; empty when none is similar.
std::vector<std::string> similar_parts(std::string_view name, const KnownParts& known);

/// The name as people write it: "Segment_3_left" -> "Segment 3 left".
std::string spoken_name(std::string_view name);

}  // namespace myotact::prepare
