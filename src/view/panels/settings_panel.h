#pragma once

#include <optional>
#include <string>

#include "view/panels/key_list.h"
#include "view/session/settings.h"

namespace myotact::view {

/// Language, colours, size, mouse, keys: they change at once, and are kept.
class SettingsPanel {
 public:
  /// `message`: why they could not be kept.
  void draw(Settings& settings, std::string& message);
  /// A key that goes down while it waits for one; false: it does not.
  bool take_key(const KeyPressed& pressed, Settings& settings, std::string& message);

 private:
  KeyList keys_;
  std::optional<double> dragged_scale_;  // while the slider is held: the sizes change when it is let go
};

/// Applies settings that changed and writes them; `message` states what is wrong where that fails.
void keep(const Settings& settings, std::string& message);

}  // namespace myotact::view
