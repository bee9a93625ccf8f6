#include "view/panels/news_strip.h"

#include <algorithm>

#include <imgui.h>

#include "view/panels/device_part.h"
#include "view/ui/controls.h"
#include "view/ui/retold.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

// Slower than this share of real time is seen and felt; a shorter time is the start of a program beside this one.
constexpr double kTooSlow = 0.9;
constexpr float kPatience_s = 3.0f;
constexpr double kSilence_s = 2.0;  // forces have faded by then, and a person wonders

/// Tissue that no other is faster to simulate than.
bool is_lightest(const std::string& tissue) {
  return tissue == "line" || tissue == "rigid";
}

}  // namespace

void NewsStrip::count_slow_time(const PanelContext& context) {
  const bool slow =
      context.frame.rates.time_factor < kTooSlow && !context.scene.state().paused && !context.news.opening;
  slow_s_ = slow ? slow_s_ + ImGui::GetIO().DeltaTime : 0.0f;
}

void NewsStrip::draw_too_slow(PanelContext& context) const {
  const double percent = 100.0 * context.frame.rates.time_factor;
  if (is_lightest(context.facts.tissue)) return ui::paragraph(ui::tr("news.too_slow_anyway", percent));
  ui::paragraph(ui::tr("news.too_slow", percent));
  if (ui::button("news.use_lines")) context.asks.wish = SceneWish{context.facts.file, "line", {}};
}

void NewsStrip::draw_devices(const PanelContext& context) const {
  for (const DeviceNews& device : context.news.devices) {
    if (!wants_a_person(device.report)) continue;
    const std::string text = sentence_about(device);
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_PlotHistogramHovered));
    ui::paragraph(text);
    ImGui::PopStyleColor();
    ui::note_control("news.device", text);
  }
}

void NewsStrip::draw(PanelContext& context, const Area& scene, std::string& message) {
  count_slow_time(context);
  const bool slow = slow_s_ > kPatience_s;
  const bool silent = context.news.silence_s > kSilence_s;
  const std::string& notice = context.frame.notice;
  const std::vector<DeviceNews>& devices = context.news.devices;
  const bool waits =
      std::any_of(devices.begin(), devices.end(), [](const auto& d) { return wants_a_person(d.report); });
  if (scene.empty() || (message.empty() && !context.news.opening && notice.empty() && !slow && !silent && !waits)) {
    return;
  }
  const float em = ImGui::GetFontSize();
  constexpr float kWidest_em = 46.0f;  // a sentence in two lines or three
  const float width = std::min(scene.width, kWidest_em * em);
  ImGui::SetNextWindowPos(ImVec2(scene.x + 0.5f * scene.width, scene.y), 0, ImVec2(0.5f, 0.0f));
  ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0.0f), ImVec2(width, scene.height));
  ImGui::Begin("news", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize |
                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoBringToFrontOnFocus |  // behind the tour
                   ImGuiWindowFlags_NoSavedSettings);
  if (!message.empty()) {
    ui::paragraph(message);
    ui::note_control("news.message", message);
    if (ui::button("news.read")) message.clear();
  }
  if (context.news.opening) ui::text("news.opening");
  if (silent) {
    const std::string text = ui::tr("news.silence", context.news.silence_s);
    ui::paragraph(text);
    ui::note_control("news.silence", text);
  }
  if (slow && !silent) draw_too_slow(context);
  draw_devices(context);
  if (!notice.empty())
    ui::paragraph(ui::retold(notice));  // last: it comes and goes, and what is clicked must not move for it
  ImGui::End();
}

}  // namespace myotact::view
