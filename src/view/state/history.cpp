#include "view/state/history.h"

namespace myotact::view {

void History::note(const WorkState& state, bool busy) {
  if (busy || state == states_[now_]) return;
  states_.resize(now_ + 1);  // what was undone is given up
  states_.push_back(state);
  if (states_.size() > kMost) states_.erase(states_.begin());
  now_ = states_.size() - 1;
}

const WorkState& History::undo() {
  if (can_undo()) --now_;
  return states_[now_];
}

const WorkState& History::redo() {
  if (can_redo()) ++now_;
  return states_[now_];
}

}  // namespace myotact::view
