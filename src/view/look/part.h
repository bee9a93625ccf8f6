#pragma once

#include <string>

#include "anatomy/specimen.h"
#include "view/look/view_state.h"

namespace myotact::view {

enum class PartKind { Muscle, Bone };

/// A muscle or a bone of the specimen.
struct Part {
  PartKind kind = PartKind::Muscle;
  int index = -1;  // as in the specimen; -1: none

  explicit operator bool() const { return index >= 0; }
  bool operator==(const Part&) const = default;
};

/// What is selected, or no part.
inline Part selected_part(const ViewState& view) {
  if (view.selected_bone >= 0) return {PartKind::Bone, view.selected_bone};
  return {PartKind::Muscle, view.selected_muscle};
}

inline const PartLook& look_of(const ViewState& view, const Part& part) {
  static constexpr PartLook kPlain;
  const auto& looks = part.kind == PartKind::Bone ? view.bones : view.muscles;
  const auto i = static_cast<std::size_t>(part.index);
  return i < looks.size() ? looks[i] : kPlain;
}

const std::string& key_of(const anatomy::Specimen& specimen, const Part& part);
/// What a part is called: "English", "Latin", or "English (Latin)"; the one that there is where the other is missing.
/// No part: an empty text.
std::string name_of(const anatomy::Specimen& specimen, const Part& part, NameStyle style);
/// As the view wants it; "?" while names are hidden.
std::string name_of(const anatomy::Specimen& specimen, const Part& part, const ViewState& view);

}  // namespace myotact::view
