#include "view/panels/start_page.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "view/panels/settings_panel.h"
#include "view/ui/controls.h"
#include "view/ui/font.h"
#include "view/ui/icons.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

void title(const char* key) {
  ui::push_type(ui::Type::Title);
  ui::paragraph(ui::tr(key));
  ImGui::PopFont();
  ImGui::Spacing();
}

/// A button over the whole width: an icon, what is done, and below it a sentence.
bool draw_tile(const char* key) {
  const float em = ImGui::GetFontSize(), gap = 0.6f * em, text_x = 3.0f * em;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, wrap = std::max(width - text_x - gap, em);
  const char* sentence = ui::tr(fmt::format("{}.sentence", key));
  const float height = ImGui::CalcTextSize(sentence, nullptr, false, wrap).y + 1.4f * em + 2.0f * gap;
  const bool pressed = ImGui::Button(fmt::format("##{}", key).c_str(), ImVec2(width, height));
  ui::note_control(key, ui::tr(key));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  constexpr float kIcon = 1.7f;
  ImFont* font = ImGui::GetFont();
  list.AddText(font, kIcon * em, ImVec2(corner.x + gap, corner.y + 0.5f * (height - kIcon * em)),
               ImGui::GetColorU32(ImGuiCol_PlotHistogram), ui::icon_of(key).c_str());
  ui::push_type(ui::Type::Heading);
  list.AddText(ImVec2(corner.x + text_x, corner.y + gap), ImGui::GetColorU32(ImGuiCol_Text), ui::tr(key));
  ImGui::PopFont();
  list.AddText(font, em, ImVec2(corner.x + text_x, corner.y + gap + 1.4f * em), ImGui::GetColorU32(ImGuiCol_Text),
               sentence, nullptr, wrap);
  return pressed;
}

/// The others, in the row of the button before.
void draw_languages(Settings& settings, std::string& message) {
  for (const std::string& code : ui::languages()) {
    if (code == settings.language) continue;
    ImGui::SameLine();
    if (!ui::button(fmt::format("comfort.language.{}", code).c_str())) continue;
    settings.language = code;
    return keep(settings, message);
  }
}

}  // namespace

std::optional<StartChoice> StartPage::draw_purposes() {
  title("start.title");
  constexpr std::array kAtOnce = {std::pair{"start.touch", Purpose::Touch}, std::pair{"start.teach", Purpose::Teach},
                                  std::pair{"start.lesson", Purpose::Lesson}};
  for (const auto& [key, purpose] : kAtOnce) {
    if (draw_tile(key)) return StartChoice{purpose};
  }
  if (draw_tile("start.prepare")) side_ = Side::Prepare;
  if (draw_tile("start.join")) side_ = Side::Join;
  ImGui::Spacing();
  if (ui::button("start.close")) open_ = false, declined_ = true;
  return {};
}

/// It is a program of its own, which takes minutes: here are its commands, to be copied.
void StartPage::draw_preparing() {
  constexpr std::array kCommands = {"myotact-prepare LIMB.seg.nrrd --guess -o my_limb", "myotact-prepare check my_limb",
                                    "myotact view elbow --set specimen=my_limb"};
  title("start.prepare");
  ui::paragraph(ui::tr("start.prepare.how"));
  for (const char* command : kCommands) {
    ImGui::PushID(command);
    std::string text = command;
    ImGui::SetNextItemWidth(-1.0f);
    ImGui::InputText("##command", text.data(), text.size() + 1, ImGuiInputTextFlags_ReadOnly);
    ImGui::PopID();
  }
  ui::paragraph(ui::tr("start.prepare.more"));
  ImGui::Spacing();
  if (ui::button("start.back")) side_ = Side::Purposes;
}

std::optional<StartChoice> StartPage::draw_joining() {
  title("start.join");
  ui::paragraph(ui::tr("start.join.how"));
  ImGui::SetNextItemWidth(-1.0f);
  ui::input_text("start.join.address", to_join_.address);
  const bool entered = ui::is_entered();
  ImGui::SetNextItemWidth(-1.0f);
  ui::input_text("start.join.token", to_join_.token);
  const bool wanted = ui::is_entered() || entered;
  ImGui::BeginDisabled(to_join_.address.empty());
  const bool joins = ui::button("start.join.now");
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (ui::button("start.back")) side_ = Side::Purposes;
  if (to_join_.address.empty() || !(joins || wanted)) return {};
  return StartChoice{Purpose::Join, to_join_};
}

std::optional<StartChoice> StartPage::draw(const Area& area, Settings& settings, std::string& message) {
  if (!open_ || area.empty()) return {};
  const float em = ImGui::GetFontSize();
  const float width = std::min(36.0f * em, area.width - em);
  ImGui::SetNextWindowPos(ImVec2(area.x + 0.5f * area.width, area.y + 0.5f * area.height), ImGuiCond_Always,
                          ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0.0f), ImVec2(width, area.height));
  ImGui::Begin("start", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize);
  std::optional<StartChoice> choice;
  switch (side_) {
    case Side::Purposes:
      choice = draw_purposes();
      draw_languages(settings, message);
      break;
    case Side::Prepare:
      draw_preparing();
      break;
    case Side::Join:
      choice = draw_joining();
      break;
  }
  ImGui::End();
  if (choice) open_ = false;
  return choice;
}

}  // namespace myotact::view
