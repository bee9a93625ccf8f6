#include "view/panels/plots_panel.h"

#include <cmath>
#include <numbers>

#include <imgui.h>

namespace myotact::view {

void PlotsPanel::add(const PanelContext& context) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  const messages::SceneFrame& frame = context.frame;
  const auto joint = static_cast<std::size_t>(context.facts.joint);
  if (joint < frame.joints.size()) {
    angle_.add(frame.time_s, frame.joints[joint].angle_rad * kDegrees);
    stiffness_.add(frame.time_s, frame.joints[joint].stiffness_Nm_rad);
  }
  double sum_N = 0.0;
  for (const messages::ToolFrame& tool : frame.tools) {
    sum_N += std::hypot(tool.force_world_N[0], tool.force_world_N[1], tool.force_world_N[2]);
  }
  if (!frame.tools.empty()) force_.add(frame.time_s, sum_N);
}

void PlotsPanel::draw() {
  const float height = 5.0f * ImGui::GetFontSize();
  angle_.draw(height);
  stiffness_.draw(height);
  force_.draw(height);
}

}  // namespace myotact::view
