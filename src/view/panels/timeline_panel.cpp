#include "view/panels/timeline_panel.h"

#include <algorithm>

#include <imgui.h>

#include "view/state/moment.h"
#include "view/ui/controls.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

/// In a narrow timeline with their icons alone: time is what it is for.
void draw_keeping(PanelContext& context) {
  constexpr float kNarrow_em = 40.0f;
  const bool narrow = ImGui::GetContentRegionAvail().x < kNarrow_em * ImGui::GetFontSize();
  const auto draw = [&](const char* key, bool on) {
    const bool pressed = narrow && !on ? ui::icon_button(key) : ui::toggle_button(key, on);
    ImGui::SameLine();
    return pressed;
  };
  const bool recording = context.scene.state().recording;
  if (draw(recording ? "keep.stop_recording" : "keep.record", recording)) context.asks.record = true;
  if (draw(context.filming ? "keep.stop_film" : "keep.film", context.filming)) context.asks.film = true;
  if (draw("keep.recordings", false)) context.asks.recordings = true;
}

}  // namespace

const messages::SceneFrame& TimelinePanel::choose(const messages::SceneFrame& present) {
  history_.add(present);
  const bool begun_anew = present.time_s < newest_s_;
  newest_s_ = present.time_s;
  if (history_.size() == 0 || begun_anew) back_to_now();  // what is looked at is no more
  if (!past_s_) return present;
  history_.fetch(*history_.nearest(*past_s_), past_);
  return past_;
}

void TimelinePanel::step(int by) {
  if (history_.size() == 0) return;
  const auto at = static_cast<std::ptrdiff_t>(*history_.nearest(past_s_.value_or(newest_s_)));
  const std::ptrdiff_t next = std::max<std::ptrdiff_t>(at + by, 0);
  if (next >= static_cast<std::ptrdiff_t>(history_.size()) - 1) return back_to_now();
  past_s_ = history_.time_s(static_cast<std::size_t>(next));
}

void TimelinePanel::draw(PanelContext& context) {
  const bool paused = context.scene.state().paused;
  draw_keeping(context);
  if (ui::icon_button("keep.step_back")) step(-1);
  ImGui::SameLine();
  if (ui::icon_button(paused ? "keep.play" : "keep.pause")) {
    context.scene.push(messages::Pause{!paused});
    back_to_now();
  }
  ImGui::SameLine();
  ImGui::BeginDisabled(!looks_back());
  if (ui::icon_button("keep.step_forward")) step(1);
  ImGui::SameLine();
  if (ui::icon_button("keep.now")) back_to_now();
  ImGui::EndDisabled();
  if (history_.size() < 2) return;
  ImGui::SameLine();
  double time_s = past_s_.value_or(newest_s_);
  const float em = ImGui::GetFontSize();
  ImGui::SetNextItemWidth(std::max(ImGui::GetContentRegionAvail().x - em, 2.0f * em));
  const ui::Range range{static_cast<float>(history_.time_s(0)), static_cast<float>(newest_s_)};
  if (ui::slider("keep.time", time_s, range, "%.2f s")) {
    // The very end of the track is the present, which moves on under the pointer.
    const double end_s = newest_s_ - 0.005 * (newest_s_ - history_.time_s(0));
    if (time_s >= end_s) {
      back_to_now();
    } else {
      past_s_ = time_s;
    }
  }
}

/// Below the banner, at the moment that it would go on from: the row of the timeline has no room left for its slider.
void TimelinePanel::draw_go_on(PanelContext& context, const Area& scene) {
  if (!looks_back() || scene.empty() || context.facts.is_served) return;  // a server's scene has no past here
  const float below = 2.4f * ImGui::GetFontSize();                        // the banner's one line and its frame
  ImGui::SetNextWindowPos(ImVec2(scene.x + 0.5f * scene.width, scene.y + below), 0, ImVec2(0.5f, 0.0f));
  ImGui::Begin("go_on", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
  if (ui::button("keep.go_on")) {
    context.asks.go_on = moment_of(past_);
    back_to_now();
  }
  ImGui::End();
}

void TimelinePanel::draw_past_banner(const Area& scene) const {
  if (looks_back()) draw_banner(scene, ui::tr("keep.looking_back", newest_s_ - past_.time_s));
}

void draw_banner(const Area& scene, const std::string& text) {
  if (scene.empty()) return;
  const float em = ImGui::GetFontSize();
  const float width = std::max(scene.width - 2.0f * em, em);
  const float wrap = std::min(ImGui::CalcTextSize(text.c_str()).x + em, width);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
  const ImVec2 corner(scene.x + 0.5f * (scene.width - size.x), scene.y + 0.7f * em);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddRectFilled(ImVec2(corner.x - 0.6f * em, corner.y - 0.3f * em),
                     ImVec2(corner.x + size.x + 0.6f * em, corner.y + size.y + 0.3f * em), IM_COL32(255, 214, 102, 255),
                     0.3f * em);
  list.AddText(ImGui::GetFont(), em, corner, IM_COL32(20, 20, 20, 255), text.c_str(), nullptr, wrap);
}

}  // namespace myotact::view
