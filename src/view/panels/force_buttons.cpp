#include "view/panels/force_buttons.h"

#include <algorithm>

#include <imgui.h>

#include "view/ui/controls.h"

namespace myotact::view {

bool forces_stopped(const messages::SceneFrame& frame) {
  return std::any_of(frame.tools.begin(), frame.tools.end(),
                     [](const messages::ToolFrame& tool) { return tool.forces_stopped; });
}

bool red_button(const char* key) {
  const ImVec4 red(0.72f, 0.11f, 0.11f, 1.0f), brighter(0.85f, 0.16f, 0.16f, 1.0f);
  ImGui::PushStyleColor(ImGuiCol_Button, red);
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, brighter);
  ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1.0f, 1.0f, 1.0f, 1.0f));
  const bool pressed = ui::button(key);
  ImGui::PopStyleColor(3);
  return pressed;
}

}  // namespace myotact::view
