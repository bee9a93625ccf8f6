#pragma once

#include <optional>
#include <string>

namespace myotact::view::ui {

/// What simulation, readers of files, connections and drivers say, in the language of the window. They speak English,
/// with values in their sentences; the English texts "said.*" are these sentences, or clauses of them, with places "{}"
/// for the values. Names of files stay, and places that stand before a text are the texts "place.*": "FILE: PLACE:
/// TEXT". A value that is such a text itself is retold, too; others stay as they are.
std::string retold(const std::string& text);

/// Empty where some sentence is none of these, and stays English in retold().
std::optional<std::string> retold_whole(const std::string& text);

}  // namespace myotact::view::ui
