#include "view/panels/help.h"

#include <fmt/format.h>
#include <imgui.h>

#include "view/key_bindings.h"
#include "view/ui/controls.h"
#include "view/ui/text.h"

namespace myotact::view {

void draw_help(bool& open) {
  ImGui::SetNextWindowPos(ImVec2(0.5f * ImGui::GetIO().DisplaySize.x, 0.5f * ImGui::GetIO().DisplaySize.y),
                          ImGuiCond_Appearing, ImVec2(0.5f, 0.5f));
  ImGui::Begin(fmt::format("{}###help", ui::tr("help.title")).c_str(), &open, ImGuiWindowFlags_AlwaysAutoResize);
  if (ImGui::BeginTable("keys", 2)) {
    for (const KeyBinding& binding : key_bindings()) {
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(name_of(binding).c_str());
      ImGui::TableNextColumn();
      ui::text(binding.what);
    }
    ImGui::EndTable();
  }
  ImGui::Separator();
  ui::text("help.mouse");
  ImGui::End();
}

}  // namespace myotact::view
