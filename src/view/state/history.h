#pragma once

#include <cstddef>
#include <vector>

#include "view/look/view_state.h"
#include "view/state/scene_state.h"

namespace myotact::view {

/// All that undo goes back over.
struct WorkState {
  ViewState view;
  SceneState scene;
  std::size_t turns = 0;  // how often the person went on from an earlier moment

  bool operator==(const WorkState&) const = default;
};

/// Undo and redo of every change of view and scene: whoever changes the state need not know of it. A drag is one step.
class History {
 public:
  explicit History(const WorkState& start) : states_{start} {}

  /// The scene of the present state was another: it changed without the person, whose next change begins from it.
  void begin_from(const SceneState& scene) { states_[now_].scene = scene; }
  /// Once a picture; `busy`: the person holds a control or drags, so that the change is not over yet.
  void note(const WorkState& state, bool busy);
  bool can_undo() const { return now_ > 0; }
  bool can_redo() const { return now_ + 1 < states_.size(); }
  /// The state before, or after; the same one where there is none.
  const WorkState& undo();
  const WorkState& redo();

 private:
  static constexpr std::size_t kMost = 500;

  std::vector<WorkState> states_;  // never empty
  std::size_t now_ = 0;
};

}  // namespace myotact::view
