#include "view/panels/key_list.h"

#include <fmt/format.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include "view/ui/controls.h"
#include "view/ui/text.h"

namespace myotact::view {

bool KeyList::waits() const {
  return waiting_.has_value() && ImGui::GetFrameCount() > waiting_since_;
}

bool KeyList::take(const KeyPressed& pressed, ChosenKeys& chosen) {
  if (pressed.key >= GLFW_KEY_LEFT_SHIFT && pressed.key <= GLFW_KEY_RIGHT_SUPER) return false;  // one more is to come
  const KeyBinding binding = *waiting_;
  waiting_.reset();
  refusal_.clear();
  if (pressed.key == GLFW_KEY_ESCAPE) return false;
  refused_ = binding.action;
  refusal_ = refusal(bindings_with(chosen), binding.action, pressed);
  if (!refusal_.empty()) return false;
  chosen[action_name(binding)] = key_name(pressed.key, pressed.mods);
  return true;
}

/// Its first key may be another action's by now.
bool KeyList::reset(const KeyBinding& binding, ChosenKeys& chosen) {
  refused_ = binding.action;
  for (const KeyBinding& first : key_bindings()) {
    if (first.action != binding.action) continue;
    refusal_ = refusal(bindings_with(chosen), first.action, {first.key, first.mods});
  }
  return refusal_.empty() && chosen.erase(action_name(binding)) > 0;
}

bool KeyList::draw_row(const KeyBinding& binding, ChosenKeys& chosen) {
  const float width = 9.0f * ImGui::GetFontSize();
  const bool waiting = waiting_ && waiting_->action == binding.action;
  const std::string shown = waiting ? ui::tr("comfort.key_press") : shown_name(binding);
  bool changed = false;
  ImGui::BeginDisabled(is_fixed(binding.action));
  if (ImGui::Button(fmt::format("{}###key", shown).c_str(), ImVec2(width, 0.0f)) && !waiting) {
    waiting_ = binding;
    waiting_since_ = ImGui::GetFrameCount();
  }
  ui::note_control(binding.what, shown);
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (chosen.contains(action_name(binding))) {
    changed = ui::button("comfort.key_reset") && reset(binding, chosen);
    ImGui::SameLine();
  }
  ui::paragraph(ui::tr(binding.what));
  if (refused_ != binding.action || refusal_.empty()) return changed;
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_PlotHistogramHovered));
  ui::paragraph(refusal_);
  ui::note_control("comfort.key_refused", refusal_);
  ImGui::PopStyleColor();
  return changed;
}

bool KeyList::draw(ChosenKeys& chosen) {
  if (!ImGui::CollapsingHeader(fmt::format("{}###comfort.keys", ui::tr("comfort.keys")).c_str())) {
    ui::note_control("comfort.keys", "closed");
    waiting_.reset();
    return false;
  }
  ui::note_control("comfort.keys", "open");
  bool changed = false;
  if (!chosen.empty() && ui::button("comfort.keys_reset")) {
    chosen.clear();
    refusal_.clear();
    changed = true;
  }
  for (const KeyBinding& binding : bindings_with(chosen)) {
    ImGui::PushID(binding.what);
    changed = draw_row(binding, chosen) || changed;
    ImGui::PopID();
  }
  return changed;
}

}  // namespace myotact::view
