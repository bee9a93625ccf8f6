#pragma once

#include <optional>
#include <string>

#include "view/input/key_choice.h"

namespace myotact::view {

/// All actions with their keys. A click on a key waits for the new one; one that another action has is refused.
class KeyList {
 public:
  /// True when `chosen` changed.
  bool draw(ChosenKeys& chosen);
  /// The next key that goes down is for take().
  bool waits() const;
  /// True when `chosen` changed. Esc leaves it as it was.
  bool take(const KeyPressed& pressed, ChosenKeys& chosen);

 private:
  bool draw_row(const KeyBinding& binding, ChosenKeys& chosen);
  bool reset(const KeyBinding& binding, ChosenKeys& chosen);

  std::optional<KeyBinding> waiting_;
  int waiting_since_ = 0;                // picture: the key that clicked is not the new one
  KeyAction refused_ = KeyAction::Help;  // what the sentence below is about
  std::string refusal_;                  // empty: none
};

}  // namespace myotact::view
