#pragma once

#include <span>

#include <imgui.h>

namespace myotact::view::ui {

/// Contrast: white on black, for a projector in a bright room.
enum class Theme { Dark, Light, Contrast };

/// Sets the colours of the current ImGui context. Every text stands out by 4.5:1 or more (WCAG 2.1, 1.4.3).
void apply_theme(Theme theme);

/// Of the two groups of muscles at a joint, wherever they oppose each other; they differ in brightness, too.
inline const ImVec4 kFlexes{0.85f, 0.45f, 0.2f, 1.0f}, kExtends{0.3f, 0.55f, 0.85f, 1.0f};

/// A colour that is read on another one.
struct TextPair {
  ImGuiCol text, ground;
};
/// All that the panels use.
std::span<const TextPair> text_pairs();

}  // namespace myotact::view::ui
