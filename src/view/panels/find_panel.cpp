#include "view/panels/find_panel.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <imgui.h>

#include "view/colour_map.h"
#include "view/ui/controls.h"

namespace myotact::view {

void FindPanel::draw(PanelContext& context) {
  const messages::SceneFrame& frame = context.frame;
  const auto& muscles = context.specimen.muscles;
  constexpr double kDarkest = 0.15;  // of the bar's colour, so that it stands out from its ground
  for (std::size_t m = 0; m < muscles.size() && m < frame.activations.size(); ++m) {
    const glm::vec3 c = cividis(std::max(frame.activations[m], kDarkest));
    const std::string text = fmt::format("{:.0f} %  {:.0f} N", 100.0 * frame.activations[m], frame.tensions_N[m]);
    if (ImGui::Selectable(muscles[m].name_en.c_str(), context.view.selected_muscle == static_cast<int>(m))) {
      context.view.selected_muscle = static_cast<int>(m);
      context.view.selected_bone = -1;
    }
    ui::note_control(fmt::format("find.{}", muscles[m].key).c_str(), text);
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, ImVec4(c.r, c.g, c.b, 1.0f));
    ImGui::ProgressBar(static_cast<float>(frame.activations[m]), ImVec2(-1.0f, 0.0f), text.c_str());
    ImGui::PopStyleColor();
  }
}

}  // namespace myotact::view
