#pragma once

#include "view/view_state.h"

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

}  // namespace myotact::view
