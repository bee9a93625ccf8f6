#include "view/panels/status_bar.h"

#include <imgui.h>

#include "view/ui/controls.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

void warn(const std::string& text) {
  ImGui::TextColored(ImGui::GetStyleColorVec4(ImGuiCol_PlotHistogramHovered), "%s", text.c_str());
  ImGui::SameLine();
}

}  // namespace

void draw_status_bar(PanelContext& context, std::string& message) {
  const messages::RateFrame& rates = context.frame.rates;
  if (!message.empty()) {
    if (ui::button("status.read")) message.clear();
    ImGui::SameLine();
    warn(message);
    ui::note_control("status.message", message);
    return;
  }
  constexpr double kTooSlow = 0.85;   // of real time
  constexpr double kSilence_s = 2.0;  // forces have faded by then, and a person wonders
  if (context.news.silence_s > kSilence_s) {
    warn(ui::tr("status.silence", context.news.silence_s));
    ui::note_control("status.silence", ui::tr("status.silence", context.news.silence_s));
  } else if (context.news.opening) {
    warn(ui::tr("status.opening"));
  } else if (!context.frame.notice.empty()) {
    warn(context.frame.notice);
  } else if (rates.time_factor < kTooSlow && context.frame.time_s > 2.0 && !context.controls.paused) {
    warn(ui::tr("status.too_slow", 100.0 * rates.time_factor));
  }
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
