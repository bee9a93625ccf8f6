#include "view/ui/controls.h"

#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "view/ui/font.h"
#include "view/ui/icons.h"
#include "view/ui/text.h"

namespace myotact::view::ui {

namespace {

struct Places {
  std::vector<ControlPlace> last, next;
};

Places& places() {
  static Places all;
  return all;
}

/// What is shown, icon and text, then what ImGui knows the control by, whatever the language.
std::string label(const char* key) {
  const std::string icon = icon_of(key);
  return fmt::format("{}{}{}###{}", icon, icon.empty() ? "" : " ", tr(key), key);
}

void show_tip(const char* key) {
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  const std::string tip = fmt::format("{}.tip", key);
  if (!has_text(tip)) return;
  constexpr float kWidth_em = 22.0f;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(kWidth_em * ImGui::GetFontSize());
  ImGui::TextUnformatted(tr(tip));
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void finish(const char* key, const std::string& value) {
  show_tip(key);
  note_control(key, value);
}

}  // namespace

void begin_controls() {
  std::swap(places().last, places().next);
  places().next.clear();
}

const std::vector<ControlPlace>& controls_of_last_picture() {
  return places().last;
}

const ControlPlace* find_control(std::string_view key) {
  const auto& controls = places().last;
  const auto found = std::find_if(controls.begin(), controls.end(), [&](const auto& c) { return c.key == key; });
  return found == controls.end() ? nullptr : &*found;
}

void note_control(const char* key, const std::string& value) {
  if (!ImGui::IsItemVisible()) return;
  const ImVec2 low = ImGui::GetItemRectMin(), size = ImGui::GetItemRectSize();
  places().next.push_back(
      {key, value, low.x, low.y, size.x, size.y, ImGui::GetIO().NavVisible && ImGui::IsItemFocused()});
}

void note_place(const ControlPlace& place) {
  places().next.push_back(place);
}

bool button(const char* key) {
  const bool pressed = ImGui::Button(label(key).c_str());
  finish(key, "");
  return pressed;
}

bool icon_button(const char* key) {
  const std::string icon = icon_of(key);
  if (icon.empty()) return button(key);
  const bool pressed = ImGui::Button(fmt::format("{}###{}", icon, key).c_str());
  const bool has_tip = has_text(fmt::format("{}.tip", key));
  if (!has_tip && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) ImGui::SetTooltip("%s", tr(key));
  finish(key, "");
  return pressed;
}

bool arrow_button(const char* key, bool to_right) {
  const bool pressed = ImGui::ArrowButton(key, to_right ? ImGuiDir_Right : ImGuiDir_Left);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", tr(key));
  note_control(key);
  return pressed;
}

std::string shortened(const std::string& text, float width) {
  const auto is_too_wide = [&](const std::string& cut) { return ImGui::CalcTextSize(cut.c_str()).x > width; };
  if (!is_too_wide(text)) return text;
  std::string begin = text;
  const auto ends_in_character = [&] { return (static_cast<unsigned char>(begin.back()) & 0xC0u) == 0x80u; };
  while (!begin.empty() && is_too_wide(begin + "...")) {
    while (begin.size() > 1 && ends_in_character()) begin.pop_back();  // UTF-8: a character's later bytes
    begin.pop_back();
  }
  return begin + "...";
}

bool hold_button(const char* key) {
  ImGui::Button(label(key).c_str());
  const bool held = ImGui::IsItemActive();
  finish(key, held ? "on" : "off");
  return held;
}

bool toggle_button(const char* key, bool on) {
  if (on) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
  const bool pressed = ImGui::Button(label(key).c_str());
  if (on) ImGui::PopStyleColor();
  finish(key, on ? "on" : "off");
  return pressed;
}

bool checkbox(const char* key, bool& value) {
  const bool changed = ImGui::Checkbox(label(key).c_str(), &value);
  finish(key, value ? "on" : "off");
  return changed;
}

bool menu_item(const char* key, bool ticked) {
  const bool chosen = ImGui::MenuItem(label(key).c_str(), nullptr, ticked);
  finish(key, ticked ? "on" : "off");
  return chosen;
}

bool slider(const char* key, double& value, const Range& range, const char* format) {
  auto number = static_cast<float>(value);
  const float track = ImGui::CalcItemWidth();
  const bool moved = ImGui::SliderFloat(label(key).c_str(), &number, range.lowest, range.highest, format);
  if (moved) value = static_cast<double>(number);
  finish(key, fmt::format("{:.4g}", value));
  if (ImGui::IsItemVisible()) places().next.back().width = track;  // without its label
  return moved;
}

bool choice(const char* key, int& value, std::span<const char* const> option_keys) {
  const auto count = static_cast<int>(option_keys.size());
  const char* shown = value >= 0 && value < count ? option_keys[static_cast<std::size_t>(value)] : nullptr;
  bool changed = false;
  const bool open =
      ImGui::BeginCombo(label(key).c_str(), shown != nullptr ? tr(shown) : "", ImGuiComboFlags_HeightLarge);
  finish(key, shown != nullptr ? shown : "");
  if (!open) return false;
  for (int i = 0; i < count; ++i) {
    const char* option = option_keys[static_cast<std::size_t>(i)];
    if (ImGui::Selectable(label(option).c_str(), i == value) && i != value) {
      value = i;
      changed = true;
    }
    finish(option, "");
  }
  ImGui::EndCombo();
  return changed;
}

bool input_text(const char* key, std::string& value) {
  const bool changed = ImGui::InputTextWithHint(fmt::format("##{}", key).c_str(), tr(key), &value);
  finish(key, value);
  return changed;
}

bool is_entered() {
  const auto pressed = [](ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), false); };
  return ImGui::IsItemDeactivated() && (pressed(ImGuiKey_Enter) || pressed(ImGuiKey_KeyPadEnter));
}

bool is_held() {
  return ImGui::IsAnyItemActive();
}

void text(const char* key) {
  ImGui::TextUnformatted(tr(key));
}

void paragraph(const std::string& text) {
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
}

void heading(const char* key) {
  ImGui::Spacing();
  push_type(Type::Heading);
  ImGui::TextColored(ImGui::GetStyleColorVec4(ImGuiCol_PlotHistogram), "%s", tr(key));
  ImGui::PopFont();
  ImGui::Separator();
}

bool begin_dialog(const char* title_key, float width_em, float height_em, bool& open) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float em = ImGui::GetFontSize();
  ImGui::SetNextWindowPos(ImVec2(0.5f * display.x, 0.5f * display.y), ImGuiCond_Appearing, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSize(ImVec2(width_em * em, height_em * em), ImGuiCond_Appearing);
  const std::string title = fmt::format("{}###{}", tr(title_key), title_key);
  return ImGui::Begin(title.c_str(), &open, ImGuiWindowFlags_NoCollapse);
}

void bar(double share, const std::string& text) {
  paragraph(text);
  constexpr float kHeight_em = 0.45f;
  ImGui::ProgressBar(static_cast<float>(std::clamp(share, 0.0, 1.0)), ImVec2(-1.0f, kHeight_em * ImGui::GetFontSize()),
                     "");
}

}  // namespace myotact::view::ui
