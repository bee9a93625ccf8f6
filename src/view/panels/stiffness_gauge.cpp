#include "view/panels/stiffness_gauge.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include "view/ui/controls.h"
#include "view/ui/font.h"
#include "view/ui/text.h"
#include "view/ui/theme.h"

namespace myotact::view {

namespace {

constexpr double kSpan_s = 20.0;
constexpr double kApart_s = 0.04;  // samples, at most 500 of them
const ImVec4 kUnstable(1.0f, 0.4f, 0.3f, 1.0f);

void draw_number(double K_Nm_rad) {
  ui::text("demonstrate.what_is_K");
  const bool unstable = K_Nm_rad < 0.0;
  ImGui::PushStyleColor(ImGuiCol_Text, unstable ? kUnstable : ImGui::GetStyleColorVec4(ImGuiCol_Text));
  ui::push_type(ui::Type::Number);
  const std::string text = ui::tr("demonstrate.K", K_Nm_rad);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopFont();
  ui::note_control("demonstrate.K", text);
  if (unstable) ui::paragraph(ui::tr("demonstrate.unstable"));
  ImGui::PopStyleColor();
}

/// Rounded to what is shown of it; what rounds to nothing has no sign.
double shown(double value, double digit) {
  return std::round(value / digit) * digit + 0.0;
}

/// From the middle to the sides, as long as the torque is large; the left over one stands in the middle.
void draw_opposition(const messages::JointFrame& joint) {
  const OpposingTorques sides = opposing_torques(joint);
  const double end_Nm = scale_end(std::max(sides.flexing_Nm, -sides.extending_Nm));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = 1.1f * ImGui::GetTextLineHeight();
  const float middle = corner.x + 0.5f * width, low = corner.y + height;
  const auto x_of = [&](double torque_Nm) { return middle - 0.5f * width * static_cast<float>(torque_Nm / end_Nm); };
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(corner, ImVec2(corner.x + width, low), ImGui::GetColorU32(ImGuiCol_FrameBg));
  list->AddRectFilled(ImVec2(x_of(sides.flexing_Nm), corner.y), ImVec2(middle, low), ImGui::GetColorU32(ui::kFlexes));
  list->AddRectFilled(ImVec2(middle, corner.y), ImVec2(x_of(sides.extending_Nm), low),
                      ImGui::GetColorU32(ui::kExtends));
  const float net = x_of(sides.flexing_Nm + sides.extending_Nm);
  list->AddLine(ImVec2(net, corner.y - 2.0f), ImVec2(net, low + 2.0f), ImGui::GetColorU32(ImGuiCol_Text), 3.0f);
  ImGui::Dummy(ImVec2(width, height));
  ui::note_control("demonstrate.opposition", fmt::format("{:.3f}", sides.flexing_Nm + sides.extending_Nm));
  constexpr double kDegrees = 57.29577951308232;
  ui::paragraph(ui::tr("demonstrate.opposition", sides.flexing_Nm, -sides.extending_Nm, shown(joint.torque_Nm, 1e-3),
                       shown(joint.angle_rad * kDegrees, 0.1)));
}

}  // namespace

OpposingTorques opposing_torques(const messages::JointFrame& joint) {
  OpposingTorques sides;
  for (const messages::MuscleJointFrame& muscle : joint.muscles) {
    (muscle.torque_Nm > 0.0 ? sides.flexing_Nm : sides.extending_Nm) += muscle.torque_Nm;
  }
  return sides;
}

double scale_end(double largest) {
  if (!(largest > 1.0) || !std::isfinite(largest)) return 1.0;
  const double decade = std::pow(10.0, std::floor(std::log10(largest)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (largest <= step * decade) return step * decade;
  }
  return 10.0 * decade;
}

void StiffnessGauge::note(double time_s, double K_Nm_rad) {
  if (!history_.empty() && time_s < history_.back().time_s) history_.clear();  // the scene began again
  if (!std::isfinite(K_Nm_rad)) return;
  if (history_.empty() || time_s >= history_.back().time_s + kApart_s) history_.push_back({time_s, K_Nm_rad});
  while (history_.back().time_s - history_.front().time_s > kSpan_s) history_.pop_front();
}

void StiffnessGauge::draw_history(const JointReadings& readings) {
  double lowest = 0.0, highest = readings.K_high_Nm_rad;
  for (const Sample& sample : history_) {
    lowest = std::min(lowest, sample.K_Nm_rad);
    highest = std::max(highest, sample.K_Nm_rad);
  }
  const double top = scale_end(highest), bottom = lowest < 0.0 ? -scale_end(-lowest) : 0.0;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, 3.6f * ImGui::GetTextLineHeight());
  const ImVec2 end(corner.x + size.x, corner.y + size.y);
  const auto y_of = [&](double K) { return end.y - size.y * static_cast<float>((K - bottom) / (top - bottom)); };
  const auto x_of = [&](double time_s) {
    return end.x - size.x * static_cast<float>((history_.back().time_s - time_s) / kSpan_s);
  };
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(corner, end, ImGui::GetColorU32(ImGuiCol_FrameBg));
  list->PushClipRect(corner, end, true);
  if (readings.K_high_Nm_rad > readings.K_low_Nm_rad) {
    list->AddRectFilled(ImVec2(corner.x, y_of(readings.K_high_Nm_rad)), ImVec2(end.x, y_of(readings.K_low_Nm_rad)),
                        ImGui::GetColorU32(ImGuiCol_PlotLines, 0.18f));
  }
  list->AddLine(ImVec2(corner.x, y_of(0.0)), ImVec2(end.x, y_of(0.0)), ImGui::GetColorU32(ImGuiCol_TextDisabled));
  std::vector<ImVec2> line;
  for (const Sample& sample : history_) line.emplace_back(x_of(sample.time_s), y_of(sample.K_Nm_rad));
  const ImU32 colour = ImGui::GetColorU32(ImGuiCol_Text);
  list->AddPolyline(line.data(), static_cast<int>(line.size()), colour, ImDrawFlags_None, 2.5f);
  list->AddCircleFilled(line.back(), 5.0f, colour);
  list->PopClipRect();
  const float gap = 0.3f * ImGui::GetFontSize();
  list->AddText(ImVec2(corner.x + gap, corner.y), ImGui::GetColorU32(ImGuiCol_TextDisabled),
                fmt::format("{:g}", top).c_str());
  ImGui::Dummy(size);
  ui::note_control("demonstrate.history", fmt::format("{:g}", top));
}

void StiffnessGauge::draw(const messages::JointFrame& joint, const JointReadings& readings) {
  if (history_.empty()) return;
  draw_number(joint.stiffness_Nm_rad);
  draw_history(readings);
  if (readings.K_low_Nm_rad != 0.0 || readings.K_high_Nm_rad != 0.0)
    ui::paragraph(ui::tr("demonstrate.K_band", readings.K_low_Nm_rad, readings.K_high_Nm_rad));
  draw_opposition(joint);
}

}  // namespace myotact::view
