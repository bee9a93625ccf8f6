#include <algorithm>
#include <array>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include "messages/device.h"
#include "view/look/part_actions.h"
#include "view/window/shown_scene.h"

// What each key does to the scene; which key that is, is in key_bindings.

namespace myotact::view {

namespace {

const char* view_of(KeyAction action) {
  constexpr std::array kViews = {std::pair{KeyAction::Lateral, "lateral"}, std::pair{KeyAction::Medial, "medial"},
                                 std::pair{KeyAction::Cranial, "cranial"}, std::pair{KeyAction::Caudal, "caudal"},
                                 std::pair{KeyAction::Dorsal, "dorsal"},   std::pair{KeyAction::Palmar, "palmar"}};
  const auto* found =
      std::find_if(kViews.begin(), kViews.end(), [&](const auto& view) { return view.first == action; });
  return found == kViews.end() ? nullptr : found->second;
}

/// Keys that move the keyboard's pointer, or the control under it.
bool moves_focus(const GlfwWindow::KeyPress& press) {
  if (press.mods != 0) return false;
  return press.key == GLFW_KEY_SPACE || press.key == GLFW_KEY_ENTER || press.key == GLFW_KEY_TAB ||
         (press.key >= GLFW_KEY_RIGHT && press.key <= GLFW_KEY_END);
}

}  // namespace

/// What the keys of the selected part do; false for other keys.
bool ShownScene::act_on_part(KeyAction action) {
  const Part part = selected_part(state_.view);
  switch (action) {
    case KeyAction::Hide:
      if (part) look_of(state_.view, part).hidden = true;
      return true;
    case KeyAction::Isolate:
      if (part) isolate(state_.view, part);
      return true;
    case KeyAction::ShowAll:
      show_all(state_.view);
      return true;
    case KeyAction::Labels:
      state_.view.labels = !state_.view.labels;
      return true;
    default:
      return false;
  }
}

/// What the keys of time and forces do; false for other keys.
bool ShownScene::act_on_play(KeyAction action) {
  switch (action) {
    case KeyAction::PauseOrPlay:
      scene_.push(messages::Pause{!scene_.state().paused});
      timeline_.back_to_now();
      return true;
    case KeyAction::Step:
      if (timeline_.looks_back()) {
        timeline_.step(1);
      } else {
        scene_.push(messages::Pause{true});
        scene_.push(messages::SingleStep{});
      }
      return true;
    case KeyAction::StepBack:
      replays() ? replay_.step(-1) : timeline_.step(-1);
      return true;
    case KeyAction::Reset:
      scene_.push(messages::Reset{});
      return true;
    case KeyAction::StopForces:
      scene_.stop_forces();
      return true;
    case KeyAction::EnableForces:
      scene_.enable_forces();
      return true;
    default:
      return false;
  }
}

void ShownScene::act(KeyAction action, WindowAsks& asks, GlfwWindow& window) {
  if (act_on_part(action) || act_on_play(action) || act_on_comfort(action, asks)) return;
  switch (action) {
    case KeyAction::Help:
      asks.help = true;
      return;
    case KeyAction::Look:
      return pointer_.set_mode(PointerMode::Look);
    case KeyAction::Touch:
      return pointer_.set_mode(PointerMode::Touch);
    case KeyAction::Pull:
      return pointer_.set_mode(PointerMode::Pull);
    case KeyAction::FrameSelection:
      asks.frame_selection = true;
      return;
    case KeyAction::FrameAll:
      asks.standard_view = "lateral";
      return;
    case KeyAction::Search:
      sides_.find = true;
      return find_.focus();
    case KeyAction::Undo:
      asks.undo = true;
      return;
    case KeyAction::Redo:
      asks.redo = true;
      return;
    case KeyAction::Screenshot:
    case KeyAction::SceneScreenshot:
      picture_wish_ = action;
      message.clear();  // not to be in the picture
      return;
    case KeyAction::Record:
      asks.record = true;
      return;
    case KeyAction::Film:
      asks.film = true;
      return;
    case KeyAction::SaveWork:
      asks.save_work = "";
      return;
    case KeyAction::OpenWork:
      asks.works = true;
      return;
    case KeyAction::FullScreen:
      return window.toggle_full_screen();
    case KeyAction::GrabLine:
    case KeyAction::GrabBone:
    case KeyAction::Clutch:
      return;  // held: read in hold_buttons()
    default:
      asks.standard_view = view_of(action);
  }
}

/// Keys that are typed into a text, or that move the control with the keyboard's focus, mean that alone; a stop goes
/// before anything else.
void ShownScene::handle_keys(WindowAsks& asks, GlfwWindow& window) {
  const ImGuiIO& io = ImGui::GetIO();
  for (const GlfwWindow::KeyPress& press : window.take_presses()) {
    const KeyBinding* binding = binding_of(keys_, press.key, press.mods);
    const bool stop = binding != nullptr && binding->action == KeyAction::StopForces;
    if (settings_panel_.take_key({press.key, press.mods}, settings, message) && !stop) continue;
    const bool taken = io.WantTextInput || (io.NavVisible && moves_focus(press));
    const char* view = settings.mouse == MousePreset::Blender ? number_pad_view(press.key, press.mods) : nullptr;
    if (binding == nullptr && view != nullptr && !taken) asks.standard_view = view;
    if (binding != nullptr && (!taken || stop)) act(binding->action, asks, window);
  }
}

/// Before the panels, where the clutch may be held too.
void ShownScene::hold_buttons(const GlfwWindow& window) {
  controls_.hand_buttons = 0;
  controls_.clutch = false;
  if (ImGui::GetIO().WantTextInput) return;
  for (const KeyBinding& binding : keys_) {
    if (!is_held(binding.action) || !window.is_down(binding.key)) continue;
    if (binding.action == KeyAction::GrabLine) controls_.hand_buttons |= messages::kGrabButton;
    if (binding.action == KeyAction::GrabBone) controls_.hand_buttons |= messages::kGrabBoneButton;
    if (binding.action == KeyAction::Clutch) controls_.clutch = !news.devices.empty();
  }
}

}  // namespace myotact::view
