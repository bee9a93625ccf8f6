#include "view/panels/toolbar.h"

#include <array>
#include <utility>

#include <imgui.h>

#include "view/panels/force_buttons.h"
#include "view/ui/controls.h"

namespace myotact::view {

namespace {

/// Always at the same place; red is what stops them alone.
void draw_force_switch(PanelContext& context) {
  if (!forces_stopped(context.frame)) {
    if (red_button("toolbar.forces_off")) context.scene.stop_forces();
  } else if (ui::button("toolbar.forces_on")) {
    context.scene.enable_forces();
  }
}

void draw_modes(PointerMode now, WindowAsks& asks) {
  constexpr std::array kModes = {std::pair{"toolbar.look", PointerMode::Look},
                                 std::pair{"toolbar.touch", PointerMode::Touch},
                                 std::pair{"toolbar.pull", PointerMode::Pull}};
  for (const auto& [key, mode] : kModes) {
    if (ui::toggle_button(key, now == mode)) asks.pointer_mode = mode;
    ImGui::SameLine();
  }
}

void draw_play(SceneControls& scene) {
  const bool paused = scene.state().paused;
  if (ui::icon_button(paused ? "toolbar.play" : "toolbar.pause")) scene.push(messages::Pause{!paused});
  ImGui::SameLine();
  if (ui::icon_button("toolbar.step")) {
    scene.push(messages::Pause{true});
    scene.push(messages::SingleStep{});
  }
  ImGui::SameLine();
  if (ui::icon_button("toolbar.reset")) scene.push(messages::Reset{});
  ImGui::SameLine();
}

void draw_saving(WindowAsks& asks) {
  if (ui::icon_button("session.save_now")) asks.save_work = "";
  ImGui::SameLine();
  if (ui::icon_button("session.works")) asks.works = true;
  ImGui::SameLine();
}

void draw_views(PanelContext& context, bool free_orbit) {
  const bool hind = anatomy::find_joint(context.specimen, "stifle") >= 0;
  const std::array views = {
      std::pair{"toolbar.lateral", "lateral"}, std::pair{"toolbar.medial", "medial"},
      std::pair{"toolbar.cranial", "cranial"}, std::pair{"toolbar.caudal", "caudal"},
      std::pair{"toolbar.dorsal", "dorsal"},   std::pair{hind ? "toolbar.plantar" : "toolbar.palmar", "palmar"}};
  for (const auto& [key, view] : views) {
    if (ui::button(key)) context.asks.standard_view = view;
    ImGui::SameLine();
  }
  if (ui::checkbox("toolbar.free_orbit", free_orbit)) context.asks.free_orbit = free_orbit;
  ImGui::SameLine();
}

/// A gap between two groups of controls.
void draw_gap() {
  ImGui::Dummy(ImVec2(0.5f * ImGui::GetFontSize(), 0.0f));
  ImGui::SameLine();
}

}  // namespace

void draw_toolbar(PanelContext& context, const ToolbarState& state) {
  draw_force_switch(context);
  ImGui::SameLine();
  draw_gap();
  draw_modes(state.pointer, context.asks);
  draw_gap();
  draw_play(context.scene);
  draw_gap();
  draw_saving(context.asks);
  constexpr float kTwoRows = 3.5f;  // heights of the font, which is more than one row takes
  ImGui::GetWindowHeight() > kTwoRows* ImGui::GetFontSize() ? ImGui::NewLine() : draw_gap();
  draw_views(context, state.free_orbit);
  draw_gap();
  ImGui::BeginDisabled(!state.can_undo);
  context.asks.undo = ui::icon_button("toolbar.undo") || context.asks.undo;
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(!state.can_redo);
  context.asks.redo = ui::icon_button("toolbar.redo") || context.asks.redo;
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (ui::button("toolbar.help")) context.asks.help = true;
  ImGui::SameLine();
  context.asks.start = ui::icon_button("toolbar.start") || context.asks.start;
}

}  // namespace myotact::view
