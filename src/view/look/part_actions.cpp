#include "view/look/part_actions.h"

#include <algorithm>

namespace myotact::view {

namespace {

/// The looks of a part's kind, and of the other.
std::vector<PartLook>& own_looks(ViewState& view, const Part& part) {
  return part.kind == PartKind::Bone ? view.bones : view.muscles;
}
std::vector<PartLook>& other_looks(ViewState& view, const Part& part) {
  return part.kind == PartKind::Bone ? view.muscles : view.bones;
}

}  // namespace

void select(ViewState& view, const Part& part) {
  view.selected_muscle = part.kind == PartKind::Muscle ? part.index : -1;
  view.selected_bone = part.kind == PartKind::Bone ? part.index : -1;
}

bool is_isolated(const ViewState& view, const Part& part) {
  const auto& own = part.kind == PartKind::Bone ? view.bones : view.muscles;
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (own[i].hidden == (static_cast<int>(i) == part.index)) return false;
  }
  return own.size() > 1;
}

void isolate(ViewState& view, const Part& part) {
  const bool back = is_isolated(view, part);
  show_all(view);
  select(view, part);
  if (back) return;
  auto& own = own_looks(view, part);
  for (std::size_t i = 0; i < own.size(); ++i) own[i].hidden = static_cast<int>(i) != part.index;
  for (PartLook& other : other_looks(view, part)) other.faded = true;
}

void show_all(ViewState& view) {
  std::fill(view.bones.begin(), view.bones.end(), PartLook{});
  std::fill(view.muscles.begin(), view.muscles.end(), PartLook{});
}

PartLook& look_of(ViewState& view, const Part& part) {
  return own_looks(view, part).at(static_cast<std::size_t>(part.index));
}

bool is_plotted(const ViewState& view, int muscle) {
  return std::find(view.plotted_muscles.begin(), view.plotted_muscles.end(), muscle) != view.plotted_muscles.end();
}

void toggle_plot(ViewState& view, int muscle) {
  if (is_plotted(view, muscle)) {
    std::erase(view.plotted_muscles, muscle);
  } else {
    view.plotted_muscles.push_back(muscle);
  }
}

}  // namespace myotact::view
