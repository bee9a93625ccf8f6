#pragma once

namespace myotact::view {

/// Keys and mouse, over everything; `open` becomes false when it is closed.
void draw_help(bool& open);

}  // namespace myotact::view
