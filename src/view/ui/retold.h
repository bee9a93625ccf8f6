#pragma once

#include <optional>
#include <string>

namespace myotact::view::ui {

/// What the simulation says of its forces, its posture and its stiffness, in the language of the window. The simulation
/// speaks English, with values in its sentences; the English texts "said.*" are these sentences with places "{}" for
/// the values. A value that is such a text itself is retold, too; others stay as they are.
std::string retold(const std::string& text);

/// Empty where some sentence is none of these, and stays English in retold().
std::optional<std::string> retold_whole(const std::string& text);

}  // namespace myotact::view::ui
