#include "view/panels/toolbar.h"

#include <algorithm>
#include <array>
#include <utility>

#include <imgui.h>

#include "view/ui/controls.h"

namespace myotact::view {

namespace {

bool forces_stopped(const messages::SceneFrame& frame) {
  return std::any_of(frame.tools.begin(), frame.tools.end(),
                     [](const messages::ToolFrame& tool) { return tool.forces_stopped; });
}

void draw_play(PanelContext& context) {
  ViewControls& controls = context.controls;
  if (ui::button(controls.paused ? "toolbar.play" : "toolbar.pause")) controls.paused = !controls.paused;
  ImGui::SameLine();
  if (ui::button("toolbar.step")) {
    controls.paused = true;
    ++controls.steps;
  }
  ImGui::SameLine();
  if (ui::button("toolbar.reset")) ++controls.resets;
  ImGui::SameLine();
  const bool stopped = forces_stopped(context.frame);
  if (ui::button(stopped ? "toolbar.forces_on" : "toolbar.forces_off")) ++(stopped ? controls.arms : controls.stops);
}

}  // namespace

ToolbarAsks draw_toolbar(PanelContext& context, bool can_undo, bool can_redo) {
  constexpr std::array kViews = {std::pair{"toolbar.lateral", "lateral"}, std::pair{"toolbar.medial", "medial"},
                                 std::pair{"toolbar.cranial", "cranial"}, std::pair{"toolbar.caudal", "caudal"},
                                 std::pair{"toolbar.dorsal", "dorsal"},   std::pair{"toolbar.palmar", "palmar"}};
  ToolbarAsks asks;
  draw_play(context);
  for (const auto& [key, view] : kViews) {
    ImGui::SameLine();
    if (ui::button(key)) asks.standard_view = view;
  }
  ImGui::SameLine();
  ImGui::BeginDisabled(!can_undo);
  asks.undo = ui::button("toolbar.undo");
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(!can_redo);
  asks.redo = ui::button("toolbar.redo");
  ImGui::EndDisabled();
  ImGui::SameLine();
  asks.help = ui::button("toolbar.help");
  return asks;
}

}  // namespace myotact::view
