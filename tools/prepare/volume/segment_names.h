#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

// What a name that a person typed says of a part. No name is too long or too odd: at most 40 words are looked at.

namespace myotact::prepare {

enum class PartKind { Bone, Muscle, Ignore };

/// "bone", "muscle", "ignore".
std::string text_of(PartKind kind);

/// A name by which others are compared: words of small letters and digits in alphabetical order, without those for
/// muscle ("M.", "musculus") and side ("left", "sin.", "R"). "M. biceps_brachii (left)" and "BicepsBrachii": "biceps
/// brachii". Empty where nothing is left.
std::string plain_name(std::string_view name);

/// The same without the words for bone, for names such as "femur bone".
std::string name_without_bone(std::string_view name);

/// "left" or "right" where the name says so, else empty.
std::string side_in(std::string_view name);

/// What the words say: muscle ("m.", "flexor", "biceps"), else bone ("os", "femur", "vertebra", "bone"), else what is
/// neither ("skin", "tendon", "vessel"). Nothing where no word is known.
std::optional<PartKind> kind_in(std::string_view name);

/// A key of small letters, digits and underscores: "Biceps Brachii (left)" -> "biceps_brachii_left". Empty where the
/// name has no letter of ASCII.
std::string key_from(std::string_view name);

}  // namespace myotact::prepare
