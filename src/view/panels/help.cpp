#include "view/panels/help.h"

#include <array>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "view/input/key_bindings.h"
#include "view/ui/controls.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

constexpr std::array kEveryMouse = {
    std::pair{"mouse.wheel", "mouse.wheel_does"}, std::pair{"mouse.click", "mouse.selects"},
    std::pair{"mouse.right_click", "mouse.menu"}, std::pair{"mouse.ctrl", "mouse.hand"}};

void draw_row(const char* how, const char* what) {
  ImGui::TableNextColumn();
  ui::text(how);
  ui::note_control(how);
  ImGui::TableNextColumn();
  ui::text(what);
}

}  // namespace

bool draw_help(bool& open, const std::vector<KeyBinding>& bindings, MousePreset mouse) {
  ImGui::SetNextWindowPos(ImVec2(0.5f * ImGui::GetIO().DisplaySize.x, 0.5f * ImGui::GetIO().DisplaySize.y),
                          ImGuiCond_Appearing, ImVec2(0.5f, 0.5f));
  constexpr float kTwoPairs_em = 74.0f;  // two keys beside each other, with what they do, in any language
  const int columns = ImGui::GetIO().DisplaySize.x < kTwoPairs_em * ImGui::GetFontSize() ? 2 : 4;
  ImGui::Begin(fmt::format("{}###help", ui::tr("help.title")).c_str(), &open, ImGuiWindowFlags_AlwaysAutoResize);
  if (ImGui::BeginTable("keys", columns, ImGuiTableFlags_SizingFixedFit)) {
    for (const KeyBinding& binding : bindings) {
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(shown_name(binding).c_str());
      ImGui::TableNextColumn();
      ui::text(binding.what);
    }
    ImGui::EndTable();
  }
  ImGui::Separator();
  if (ImGui::BeginTable("mouse", columns, ImGuiTableFlags_SizingFixedFit)) {
    for (const MouseRow& row : mouse_rows(mouse)) draw_row(row.how, row.what);
    for (const auto& [how, what] : kEveryMouse) draw_row(how, what);
    if (mouse == MousePreset::Blender) draw_row("mouse.number_pad", "mouse.views");
    ImGui::EndTable();
  }
  const bool wants_tour = ui::button("help.tour");
  ImGui::End();
  return wants_tour;
}

}  // namespace myotact::view
