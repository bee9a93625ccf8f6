#include "view/panels/works_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include "view/ui/controls.h"
#include "view/ui/text.h"

namespace myotact::view {

void WorksPanel::toggle() {
  open_ = !open_;
  refresh();
}

void WorksPanel::refresh() {
  if (open_) works_ = list_works();
}

void WorksPanel::draw_list(PanelContext& context) {
  if (works_.empty()) return ui::paragraph(ui::tr("session.none"));
  constexpr float kTimeColumn_em = 17.0f;
  for (std::size_t i = 0; i < works_.size(); ++i) {
    const ListedWork& work = works_[i];
    const float start = ImGui::GetCursorPosX();
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable("##work")) {
      context.asks.open_work = work.file;
      open_ = false;
    }
    ui::note_control(fmt::format("session.work.{}", i).c_str(), work.file.string());
    ImGui::SameLine(start);
    ImGui::TextUnformatted(work.name.c_str());
    ImGui::SameLine(start + kTimeColumn_em * ImGui::GetFontSize());
    ImGui::TextDisabled("%s", work.time.c_str());
    ImGui::PopID();
  }
}

void WorksPanel::draw(PanelContext& context) {
  if (!open_) return;
  if (ui::begin_dialog("session.title", 30.0f, 22.0f, open_)) {
    constexpr float kName = 0.7f;  // of the width
    ImGui::SetNextItemWidth(kName * ImGui::GetContentRegionAvail().x);
    ui::input_text("session.name", name_);
    const bool entered = ui::is_entered();
    ImGui::SameLine();
    if (ui::button("session.save") || entered) {
      context.asks.save_work = name_;
      name_.clear();
    }
    ImGui::Separator();
    ImGui::BeginChild("list", ImVec2(0.0f, -4.0f * ImGui::GetFontSize()));
    draw_list(context);
    ImGui::EndChild();
    ImGui::Separator();
    ui::paragraph(ui::tr("session.folder", works_folder().string()));
  }
  ImGui::End();
}

}  // namespace myotact::view
