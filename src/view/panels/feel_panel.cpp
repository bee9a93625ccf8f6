#include "view/panels/feel_panel.h"

#include <cmath>
#include <string>

#include <imgui.h>

#include "view/tool_drawing.h"
#include "view/ui/text.h"

namespace myotact::view {

void FeelPanel::draw(PanelContext& context) {
  const auto& tools = context.frame.tools;
  for (std::size_t t = 0; t < tools.size() && t < context.facts.device_peaks_N.size(); ++t) {
    const auto& f = tools[t].force_world_N;
    const double force_N = std::hypot(f[0], f[1], f[2]), peak_N = context.facts.device_peaks_N[t];
    const char* key = tools.size() == 1 ? "feel.force" : tools[t].left ? "feel.force_left" : "feel.force_right";
    const glm::vec3 colour = tool_colour(tools[t]);
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, ImVec4(colour.r, colour.g, colour.b, 1.0f));
    ImGui::ProgressBar(static_cast<float>(force_N / peak_N), ImVec2(-1, 0), ui::tr(key, force_N, peak_N).c_str());
    ImGui::PopStyleColor();
  }
}

}  // namespace myotact::view
