#include "view/panels/replay_panel.h"

#include <algorithm>
#include <variant>

#include <imgui.h>

#include "view/ui/controls.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

constexpr float kSlowest = 0.1f, kFastest = 2.0f;  // times as fast as it was
constexpr double kStep_s = 0.01;                   // where no neighbour is kept yet: a step of most scenes

}  // namespace

const messages::SceneFrame& ReplayPanel::choose(const messages::SceneFrame& newest, double length_s,
                                                SceneControls& scene) {
  history_.add(newest);
  newest_s_ = newest.time_s;
  length_s_ = length_s;
  if (!scene.state().paused) {
    // The clock waits for the simulation, or a slow computer would skip what it is to show.
    constexpr double kAhead_s = 0.1;
    const double next_s = place_s_ + speed_ * static_cast<double>(ImGui::GetIO().DeltaTime);
    place_s_ = std::max(place_s_, std::min(next_s, newest_s_ + kAhead_s));
    if (place_s_ >= length_s_) scene.push(messages::Pause{true});
  }
  place_s_ = std::clamp(place_s_, 0.0, length_s_);
  if (place_s_ >= newest_s_ || history_.size() == 0) return newest;
  history_.fetch(*history_.nearest(place_s_), shown_);
  return shown_;
}

void ReplayPanel::obey(const messages::Order& order) {
  if (std::holds_alternative<messages::SingleStep>(order)) step(1);
  if (std::holds_alternative<messages::Reset>(order)) place_s_ = 0.0;
}

void ReplayPanel::step(int by) {
  const auto nearest = history_.nearest(place_s_);
  if (!nearest) return;
  const auto next = static_cast<std::ptrdiff_t>(*nearest) + by;
  if (next < 0 || next >= static_cast<std::ptrdiff_t>(history_.size())) {
    place_s_ = std::clamp(place_s_ + by * kStep_s, 0.0, length_s_);
  } else {
    place_s_ = history_.time_s(static_cast<std::size_t>(next));
  }
}

void ReplayPanel::draw(PanelContext& context) {
  SceneControls& scene = context.scene;
  const bool paused = scene.state().paused;
  if (ui::button("keep.to_scene")) {
    context.asks.wish = SceneWish{context.facts.file, context.facts.tissue, {}, {}, {}};
  }
  ImGui::SameLine();
  if (ui::toggle_button(context.filming ? "keep.stop_film" : "keep.film", context.filming)) context.asks.film = true;
  ImGui::SameLine();
  if (ui::button("keep.replay_back")) {
    scene.push(messages::Pause{true});
    step(-1);
  }
  ImGui::SameLine();
  if (ui::button(paused ? "keep.replay_play" : "keep.replay_pause")) {
    if (paused && place_s_ >= length_s_) place_s_ = 0.0;  // at the end: once more
    scene.push(messages::Pause{!paused});
  }
  ImGui::SameLine();
  if (ui::button("keep.replay_forward")) {
    scene.push(messages::Pause{true});
    step(1);
  }
  ImGui::SameLine();
  const float em = ImGui::GetFontSize();
  ImGui::SetNextItemWidth(6.0f * em);
  ui::slider("keep.replay_speed", speed_, {kSlowest, kFastest}, "x %.1f");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(std::max(ImGui::GetContentRegionAvail().x - em, 4.0f * em));
  ui::slider("keep.replay_time", place_s_, {0.0f, static_cast<float>(length_s_)}, "%.2f s");
}

}  // namespace myotact::view
