#include "view/input/area_focus.h"

#include <array>
#include <string_view>
#include <vector>

#include <imgui.h>
#include <imgui_internal.h>  // 1.86 has no public way to show the keyboard's pointer in a window

namespace myotact::view {

namespace {

/// A window and, after it, what scrolls within it, where there is anything for the keyboard.
void add_with_children(ImGuiWindow* window, std::vector<ImGuiWindow*>& stops) {
  if (window == nullptr) return;
  if (window->DC.NavLayersActiveMaskNext != 0) stops.push_back(window);
  for (ImGuiWindow* child : window->DC.ChildWindows) add_with_children(child, stops);
}

}  // namespace

void focus_next_area(const Layout& layout, int step) {
  struct Named {
    const char* window;
    const Area* area;
  };
  const std::array all = {Named{"toolbar", &layout.toolbar}, Named{"find", &layout.find}, Named{"tasks", &layout.tasks},
                          Named{"timeline", &layout.timeline}};
  std::vector<ImGuiWindow*> shown;
  for (const Named& named : all) {
    if (!named.area->empty()) add_with_children(ImGui::FindWindowByName(named.window), shown);
  }
  if (shown.empty()) return;
  ImGuiContext& imgui = *ImGui::GetCurrentContext();
  const auto count = static_cast<int>(shown.size());
  int place = step > 0 ? -1 : count;  // of the area that has it now; outside: none
  for (int i = 0; i < count; ++i) {
    if (imgui.NavWindow == shown[static_cast<std::size_t>(i)] && ImGui::GetIO().NavVisible) place = i;
  }
  ImGuiWindow* next = shown[static_cast<std::size_t>(((place + step) % count + count) % count)];
  ImGui::ClearActiveID();
  ImGui::FocusWindow(next);
  ImGui::NavInitWindow(next, true);
  imgui.NavDisableHighlight = false;
  imgui.NavDisableMouseHover = true;
}

}  // namespace myotact::view
