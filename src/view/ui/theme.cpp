#include "view/ui/theme.h"

#include <array>

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
    TextPair{ImGuiCol_TextDisabled, ImGuiCol_WindowBg},
    TextPair{ImGuiCol_PlotHistogram, ImGuiCol_WindowBg},         // headings
    TextPair{ImGuiCol_PlotHistogramHovered, ImGuiCol_WindowBg},  // warnings
};

}  // namespace

void apply_theme(Theme theme) {
  ImVec4* colours = ImGui::GetStyle().Colors;
  if (theme == Theme::Light) {
    ImGui::StyleColorsLight();
    colours[ImGuiCol_TextDisabled] = ImVec4(0.35f, 0.35f, 0.35f, 1.0f);
    colours[ImGuiCol_PlotHistogram] = ImVec4(0.47f, 0.31f, 0.0f, 1.0f);
    colours[ImGuiCol_PlotHistogramHovered] = ImVec4(0.66f, 0.16f, 0.0f, 1.0f);
  } else {
    ImGui::StyleColorsDark();
    // ImGui's own are brighter: white text on them has 3:1.
    colours[ImGuiCol_TextDisabled] = ImVec4(0.62f, 0.62f, 0.62f, 1.0f);
    colours[ImGuiCol_ButtonHovered] = ImVec4(0.18f, 0.42f, 0.72f, 1.0f);
    colours[ImGuiCol_ButtonActive] = ImVec4(0.06f, 0.38f, 0.72f, 1.0f);
    colours[ImGuiCol_HeaderHovered] = ImVec4(0.18f, 0.42f, 0.72f, 1.0f);
    colours[ImGuiCol_HeaderActive] = ImVec4(0.18f, 0.42f, 0.72f, 1.0f);
    colours[ImGuiCol_TabHovered] = ImVec4(0.18f, 0.42f, 0.72f, 1.0f);
    colours[ImGuiCol_PlotHistogramHovered] = ImVec4(1.0f, 0.60f, 0.20f, 1.0f);
  }
  if (theme != Theme::Contrast) return;
  colours[ImGuiCol_Text] = ImVec4(1.0f, 1.0f, 1.0f, 1.0f);
  colours[ImGuiCol_TextDisabled] = ImVec4(0.80f, 0.80f, 0.80f, 1.0f);
  colours[ImGuiCol_WindowBg] = colours[ImGuiCol_PopupBg] = ImVec4(0.0f, 0.0f, 0.0f, 1.0f);
  colours[ImGuiCol_Border] = ImVec4(0.85f, 0.85f, 0.85f, 1.0f);
}

std::span<const TextPair> text_pairs() {
  return kPairs;
}

}  // namespace myotact::view::ui
