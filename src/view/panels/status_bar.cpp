#include "view/panels/status_bar.h"

#include <imgui.h>

#include "view/ui/text.h"

namespace myotact::view {

void draw_status_bar(const PanelContext& context) {
  const messages::RateFrame& rates = context.frame.rates;
  if (!context.frame.tools.empty()) {
    const messages::ToolFrame& tool = context.frame.tools.front();
    ImGui::TextUnformatted(ui::tr("status.scales", tool.force_scale, tool.motion_scale).c_str());
    ImGui::SameLine();
  }
  ImGui::TextUnformatted(
      ui::tr("status.rates", rates.simulation_hz, rates.haptic_hz, rates.missed_ticks, rates.time_factor).c_str());
  ImGui::SameLine();
  ImGui::TextUnformatted(ui::tr("status.not_medical"));
}

}  // namespace myotact::view
