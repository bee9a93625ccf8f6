#include "view/ui/theme.h"

#include <array>
#include <initializer_list>

namespace myotact::view::ui {

namespace {

constexpr std::array kPairs = {
    TextPair{ImGuiCol_Text, ImGuiCol_WindowBg},
    TextPair{ImGuiCol_Text, ImGuiCol_PopupBg},
    TextPair{ImGuiCol_Text, ImGuiCol_FrameBg},
    TextPair{ImGuiCol_Text, ImGuiCol_FrameBgHovered},
    TextPair{ImGuiCol_Text, ImGuiCol_FrameBgActive},
    TextPair{ImGuiCol_Text, ImGuiCol_Button},
    TextPair{ImGuiCol_Text, ImGuiCol_ButtonHovered},
    TextPair{ImGuiCol_Text, ImGuiCol_ButtonActive},
    TextPair{ImGuiCol_Text, ImGuiCol_Header},
    TextPair{ImGuiCol_Text, ImGuiCol_HeaderHovered},
    TextPair{ImGuiCol_Text, ImGuiCol_HeaderActive},
    TextPair{ImGuiCol_Text, ImGuiCol_Tab},
    TextPair{ImGuiCol_Text, ImGuiCol_TabHovered},
    TextPair{ImGuiCol_Text, ImGuiCol_TabActive},
    TextPair{ImGuiCol_Text, ImGuiCol_SliderGrab},  // the number passes over it
    TextPair{ImGuiCol_TextDisabled, ImGuiCol_WindowBg},
    TextPair{ImGuiCol_PlotHistogram, ImGuiCol_WindowBg},         // headings
    TextPair{ImGuiCol_PlotHistogramHovered, ImGuiCol_WindowBg},  // warnings
};

/// Greys, and one accent: deep as a ground of text (what is chosen), bright as a line, a mark or a heading.
struct Palette {
  unsigned window, popup, border;               // 0xRRGGBB
  unsigned field, field_hovered, field_active;  // that is filled in: sliders, boxes
  unsigned button, button_hovered;
  unsigned chosen, accent;
  unsigned text, faint_text, warning;
};

constexpr Palette kDark = {0x16181B, 0x1E2125, 0x31363C, 0x23272C, 0x2D3238, 0x363C43, 0x2B3036,
                           0x3A4149, 0x0F706A, 0x4FD1C5, 0xE8EAED, 0x9AA3AD, 0xFFB057};
constexpr Palette kLight = {0xFAFAF9, 0xFFFFFF, 0xCFD4D9, 0xE9ECEF, 0xDFE3E7, 0xD3D9DE, 0xE3E7EA,
                            0xD3D9DE, 0x99D9D2, 0x0B655E, 0x1B1F23, 0x565E66, 0xA33A00};
constexpr Palette kContrast = {0x000000, 0x000000, 0xD9D9D9, 0x1E2125, 0x2D3238, 0x363C43, 0x2B3036,
                               0x3A4149, 0x0F706A, 0x6FE8DC, 0xFFFFFF, 0xCCCCCC, 0xFFB057};

ImVec4 colour_of(unsigned rgb, float opacity = 1.0f) {
  constexpr float kFull = 255.0f;
  return {static_cast<float>((rgb >> 16u) & 0xFFu) / kFull, static_cast<float>((rgb >> 8u) & 0xFFu) / kFull,
          static_cast<float>(rgb & 0xFFu) / kFull, opacity};
}

void apply(const Palette& palette) {
  ImVec4* colours = ImGui::GetStyle().Colors;
  const auto set = [&](unsigned rgb, std::initializer_list<ImGuiCol> places) {
    for (const ImGuiCol place : places) colours[place] = colour_of(rgb);
  };
  set(palette.window, {ImGuiCol_WindowBg, ImGuiCol_Tab, ImGuiCol_ScrollbarBg, ImGuiCol_MenuBarBg});
  set(palette.popup, {ImGuiCol_PopupBg, ImGuiCol_TitleBg, ImGuiCol_TitleBgActive, ImGuiCol_TitleBgCollapsed});
  set(palette.border, {ImGuiCol_Border, ImGuiCol_Separator, ImGuiCol_TableBorderStrong, ImGuiCol_TableBorderLight});
  set(palette.field, {ImGuiCol_FrameBg, ImGuiCol_Header, ImGuiCol_TableHeaderBg});
  set(palette.field_hovered, {ImGuiCol_FrameBgHovered, ImGuiCol_ScrollbarGrab, ImGuiCol_ResizeGrip});
  set(palette.field_active, {ImGuiCol_FrameBgActive, ImGuiCol_ScrollbarGrabHovered, ImGuiCol_ResizeGripHovered});
  set(palette.button, {ImGuiCol_Button});
  set(palette.button_hovered, {ImGuiCol_ButtonHovered, ImGuiCol_HeaderHovered, ImGuiCol_TabHovered});
  set(palette.chosen, {ImGuiCol_ButtonActive, ImGuiCol_HeaderActive, ImGuiCol_TabActive, ImGuiCol_TabUnfocusedActive,
                       ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive});
  set(palette.accent,
      {ImGuiCol_CheckMark, ImGuiCol_PlotHistogram, ImGuiCol_PlotLines, ImGuiCol_NavHighlight, ImGuiCol_SeparatorHovered,
       ImGuiCol_SeparatorActive, ImGuiCol_ScrollbarGrabActive, ImGuiCol_ResizeGripActive, ImGuiCol_DragDropTarget});
  set(palette.text, {ImGuiCol_Text});
  set(palette.faint_text, {ImGuiCol_TextDisabled});
  set(palette.warning, {ImGuiCol_PlotHistogramHovered, ImGuiCol_PlotLinesHovered});
  constexpr float kSelection = 0.35f;  // of opacity: the selected text is read through it
  colours[ImGuiCol_TextSelectedBg] = colour_of(palette.accent, kSelection);
}

}  // namespace

void apply_theme(Theme theme) {
  if (theme == Theme::Light) {
    ImGui::StyleColorsLight();
    apply(kLight);
  } else {
    ImGui::StyleColorsDark();
    apply(theme == Theme::Contrast ? kContrast : kDark);
  }
}

std::span<const TextPair> text_pairs() {
  return kPairs;
}

}  // namespace myotact::view::ui
