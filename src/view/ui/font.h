#pragma once

namespace myotact::view::ui {

/// What Debian's package fonts-dejavu-core installs.
inline constexpr const char* kFontFile = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

/// Adds the font of the interface to the current ImGui context; where there is no such file, ImGui's own in the same
/// height, and it returns false.
bool add_font(float height_px, const char* file = kFontFile);

}  // namespace myotact::view::ui
