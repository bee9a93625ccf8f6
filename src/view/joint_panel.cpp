#include "view/joint_panel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <imgui.h>

namespace myotact::view {
namespace {

const ImVec4 kStiffens(0.3f, 0.55f, 0.85f, 1.0f), kSoftens(0.85f, 0.45f, 0.2f, 1.0f), kUnstable(1.0f, 0.4f, 0.3f, 1.0f);

struct Part {
  const char* name;
  double K_Nm_rad;
  const char* hint;
};

/// A bar to the right of the middle for what stiffens, to the left for what softens.
void draw_part(const Part& part, double largest_Nm_rad) {
  constexpr float kWidth = 150.0f;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetTextLineHeight();
  const float middle = corner.x + 0.5f * kWidth;
  const float end = middle + 0.5f * kWidth * static_cast<float>(part.K_Nm_rad / largest_Nm_rad);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(ImVec2(std::min(middle, end), corner.y + 2.0f),
                      ImVec2(std::max(middle, end), corner.y + height - 2.0f),
                      ImGui::GetColorU32(part.K_Nm_rad < 0.0 ? kSoftens : kStiffens));
  list->AddLine(ImVec2(middle, corner.y), ImVec2(middle, corner.y + height), ImGui::GetColorU32(ImGuiCol_TextDisabled));
  ImGui::Dummy(ImVec2(kWidth, height));
  ImGui::SameLine();
  ImGui::Text("%+7.2f %s", part.K_Nm_rad, part.name);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", part.hint);
}

std::string headline(const messages::JointFrame& joint, const JointReadings& readings) {
  std::string text = fmt::format("K = {:.2f} N m/rad", joint.stiffness_Nm_rad);
  if (joint.stiffness_Nm_rad < 0.0) text += "  UNSTABLE";
  if (readings.K_low_Nm_rad == 0.0 && readings.K_high_Nm_rad == 0.0) return text;
  return text + fmt::format("  ({:.2f} .. {:.2f} within the anatomy's uncertainty)", readings.K_low_Nm_rad,
                            readings.K_high_Nm_rad);
}

}  // namespace

void draw_joint(const messages::JointFrame& joint, const JointReadings& readings, ViewControls& controls) {
  const bool unstable = joint.stiffness_Nm_rad < 0.0;
  ImGui::PushStyleColor(ImGuiCol_Text, unstable ? kUnstable : ImGui::GetStyleColorVec4(ImGuiCol_Text));
  ImGui::TextWrapped("%s", headline(joint, readings).c_str());
  ImGui::PopStyleColor();
  const std::array parts = {
      Part{"muscle r^2 k", readings.K_muscle_Nm_rad, "the fibres' stiffness at their levers"},
      Part{"geometry -(dr/dq) F", readings.K_geometry_Nm_rad, "levers that change as the joint turns"},
      Part{"contact", readings.K_contact_Nm_rad, "tissue that presses on bone and on tissue"},
      Part{"passive joint", readings.K_passive_Nm_rad, "capsule, ligaments, the end of the range"}};
  double largest_Nm_rad = 1e-3;
  for (const Part& part : parts) largest_Nm_rad = std::max(largest_Nm_rad, std::abs(part.K_Nm_rad));
  for (const Part& part : parts) draw_part(part, largest_Nm_rad);
  if (!readings.why.empty()) ImGui::TextWrapped("%s", readings.why.c_str());
  if (ImGui::Button("Shove test")) ++controls.shoves;
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("a slow push of a degree, then a stroke: 4 s");
  if (!readings.shove.empty()) ImGui::TextWrapped("%s", readings.shove.c_str());
}

}  // namespace myotact::view
