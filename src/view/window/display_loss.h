#pragma once

#include <functional>

namespace myotact::view {

/// What is to be done when the display goes away (its server ends, its connection breaks): X11 then allows no return to
/// the program, which ends with 69 after `last_action` and a sentence. Called on the thread that draws, with a window
/// open. Before it nothing is done; an empty one takes it back.
void on_display_loss(std::function<void()> last_action);

}  // namespace myotact::view
