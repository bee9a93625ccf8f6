#include "view/area_focus.h"

#include <array>
#include <string_view>
#include <vector>

#include <imgui.h>
#include <imgui_internal.h>  // 1.86 has no public way to show the keyboard's pointer in a window

namespace myotact::view {

void focus_next_area(const Layout& layout, int step) {
  struct Named {
    const char* window;
    const Area* area;
  };
  const std::array all = {Named{"toolbar", &layout.toolbar}, Named{"find", &layout.find}, Named{"tasks", &layout.tasks},
                          Named{"timeline", &layout.timeline}};
  std::vector<ImGuiWindow*> shown;
  for (const Named& named : all) {
    if (!named.area->empty()) shown.push_back(ImGui::FindWindowByName(named.window));
  }
  if (shown.empty()) return;
  ImGuiContext& imgui = *ImGui::GetCurrentContext();
  const auto count = static_cast<int>(shown.size());
  int place = step > 0 ? -1 : count;  // of the area that has it now; outside: none
  for (int i = 0; i < count; ++i) {
    const ImGuiWindow* window = shown[static_cast<std::size_t>(i)];
    if (imgui.NavWindow != nullptr && imgui.NavWindow->RootWindow == window && ImGui::GetIO().NavVisible) place = i;
  }
  ImGuiWindow* next = shown[static_cast<std::size_t>(((place + step) % count + count) % count)];
  if (next == nullptr) return;
  ImGui::ClearActiveID();
  ImGui::FocusWindow(next);
  ImGui::NavInitWindow(next, true);
  imgui.NavDisableHighlight = false;
  imgui.NavDisableMouseHover = true;
}

}  // namespace myotact::view
