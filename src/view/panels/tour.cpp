#include "view/panels/tour.h"

#include <algorithm>
#include <array>

#include <imgui.h>

#include "view/ui/controls.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

struct Step {
  const char* text;
  const char* control;  // that it is about
};

constexpr std::array kSteps = {Step{"tour.find", "find.search"},        Step{"tour.look", "toolbar.look"},
                               Step{"tour.touch", "toolbar.touch"},     Step{"tour.pull", "toolbar.pull"},
                               Step{"tour.stop", "toolbar.forces_off"}, Step{"tour.demonstrate", "tasks.demonstrate"},
                               Step{"tour.learn", "tasks.learn"}};

/// A frame round the control, and the place beside it; the middle of the window where it is not shown.
ImVec2 mark(const char* key) {
  const ui::ControlPlace* found = ui::find_control(key);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  if (found == nullptr) return {0.4f * display.x, 0.4f * display.y};
  constexpr float kGap = 4.0f;
  const ImVec2 low(found->x - kGap, found->y - kGap);
  const ImVec2 high(found->x + found->width + kGap, found->y + found->height + kGap);
  ImGui::GetForegroundDrawList()->AddRect(low, high, ImGui::GetColorU32(ImGuiCol_PlotHistogram), 4.0f, 0, 3.0f);
  return {low.x, high.y + 2.0f * kGap};
}

}  // namespace

bool Tour::draw() {
  const float width = 22.0f * ImGui::GetFontSize();
  ImVec2 place = mark(kSteps[step_].control);
  place.x = std::clamp(place.x, 0.0f, std::max(ImGui::GetIO().DisplaySize.x - width, 0.0f));
  ImGui::SetNextWindowPos(place);
  ImGui::SetNextWindowSize(ImVec2(width, 0.0f));
  ImGui::SetNextWindowBgAlpha(1.0f);  // it stands over other texts
  ImGui::Begin("tour", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
  ui::paragraph(ui::tr("tour.step", step_ + 1, kSteps.size()));
  ui::paragraph(ui::tr(kSteps[step_].text));
  ImGui::BeginDisabled(step_ == 0);
  if (ui::button("tour.back")) --step_;
  ImGui::EndDisabled();
  ImGui::SameLine();
  const bool last = step_ + 1 == kSteps.size();
  bool over = false;
  if (ui::button(last ? "tour.done" : "tour.next")) {
    over = last;
    step_ = last ? 0 : step_ + 1;
  }
  ImGui::SameLine();
  if (!last && ui::button("tour.skip")) over = true;
  ImGui::End();
  return over;
}

}  // namespace myotact::view
