#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <imgui.h>

#include "view/ui/controls.h"
#include "view/ui/text.h"
#include "view/window/shown_scene.h"

// Keys that save ways of the hand, and big type for a class.

namespace myotact::view {

namespace {

const char* task_of(KeyAction action) {
  constexpr std::array kTasks = {std::pair{KeyAction::TaskFeel, "tasks.feel"},
                                 std::pair{KeyAction::TaskSee, "tasks.see"},
                                 std::pair{KeyAction::TaskDemonstrate, "tasks.demonstrate"},
                                 std::pair{KeyAction::TaskLearn, "tasks.learn"},
                                 std::pair{KeyAction::TaskPlots, "tasks.plots"},
                                 std::pair{KeyAction::TaskSettings, "tasks.settings"}};
  const auto* found =
      std::find_if(kTasks.begin(), kTasks.end(), [&](const auto& task) { return task.first == action; });
  return found == kTasks.end() ? nullptr : found->second;
}

}  // namespace

/// What the keys of areas, tasks and the class do; false for other keys.
bool ShownScene::act_on_comfort(KeyAction action, WindowAsks& asks) {
  if (const char* task = task_of(action)) {
    open_task_ = task;
    sides_.tasks = true;
    return true;
  }
  switch (action) {
    case KeyAction::NextArea:
      area_step_ = 1;
      return true;
    case KeyAction::PreviousArea:
      area_step_ = -1;
      return true;
    case KeyAction::LessCoContraction:
      asks.co_contraction_step = -kCoContractionStep;
      return true;
    case KeyAction::MoreCoContraction:
      asks.co_contraction_step = kCoContractionStep;
      return true;
    case KeyAction::BigType:
      asks.big_type = true;
      return true;
    case KeyAction::FoldFind:
      sides_.find = !sides_.find;
      return true;
    case KeyAction::FoldTasks:
      sides_.tasks = !sides_.tasks;
      return true;
    case KeyAction::OtherState:
      if (!demonstrate_.feel_other(scene_)) message = ui::tr("demonstrate.none_kept");
      return true;
    default:
      return false;
  }
}

/// At the scene's upper corners; a window that is too small for a panel has no handle for it either.
void ShownScene::draw_fold_handles() {
  const auto handle = [&](const char* key, float x, float pivot, bool& open, bool is_left) {
    ImGui::SetNextWindowPos(ImVec2(x, layout_.scene.y), 0, ImVec2(pivot, 0.0f));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(2.0f, 2.0f));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1.0f, 1.0f));
    ImGui::Begin(key, nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
    if (ui::arrow_button(key, open != is_left)) open = !open;
    ImGui::End();
    ImGui::PopStyleVar(2);
  };
  if (big_type_) return;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const auto laid_out = [&](const SidePanels& sides) {
    return layout_of(display.x, display.y, ImGui::GetFontSize(), sides);
  };
  if (!laid_out({true, sides_.tasks}).find.empty()) handle("fold.find", layout_.scene.x, 0.0f, sides_.find, true);
  if (!laid_out({false, true}).tasks.empty())
    handle("fold.tasks", layout_.scene.x + layout_.scene.width, 1.0f, sides_.tasks, false);
}

/// Of both sides of the joint, whatever drove the muscles before: from the level in force on.
void ShownScene::add_co_contraction(double step) {
  const messages::ControlState& now = scene_.state();
  const double common = now.drive == Drive::Balance ? now.common : now.common_now;
  scene_.push(messages::CoContract{std::clamp(common + step, 0.0, 1.0), now.difference});
}

void ShownScene::set_big_type(bool on) {
  big_type_ = on;
  if (!on) apply(settings);
}

double ShownScene::scale() const {
  constexpr double kForAClass = 1.6;  // letters of 24 pixels on a projector of 720 or 800 lines
  return big_type_ ? std::max(settings.scale, kForAClass) : settings.scale;
}

double ShownScene::share_of_force() const {
  if (shown_ == nullptr) return 0.0;
  double share = 0.0;
  for (std::size_t t = 0; t < shown_->tools.size() && t < facts_.device_peaks_N.size(); ++t) {
    const auto& [x, y, z] = shown_->tools[t].force_world_N;
    share = std::max(share, std::hypot(x, y, z) / facts_.device_peaks_N[t]);
  }
  return share;
}

}  // namespace myotact::view
