#pragma once

#include <string>
#include <string_view>

#include <imgui.h>

namespace myotact::view::ui {

/// The icon of a control, in UTF-8; empty where the control has none, or the current font lacks it.
std::string icon_of(std::string_view key);

/// All icons, as ImGui's font atlas takes them: pairs of first and last character, ended with 0.
const ImWchar* icon_ranges();

}  // namespace myotact::view::ui
