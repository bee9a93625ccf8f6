#include "view/panels/part_menu.h"

#include <imgui.h>

#include "view/look/part_actions.h"
#include "view/ui/controls.h"

namespace myotact::view {

void PartMenu::draw(PanelContext& context) {
  constexpr const char* kId = "part";
  if (context.asks.menu_of) {
    part_ = context.asks.menu_of;
    select(context.view, part_);
    ImGui::OpenPopup(kId);
  }
  if (!ImGui::BeginPopup(kId)) return;
  ViewState& view = context.view;
  ImGui::TextUnformatted(name_of(context.specimen, part_, view).c_str());
  ImGui::Separator();
  PartLook& look = look_of(view, part_);
  if (ui::menu_item(look.hidden ? "menu.show" : "menu.hide")) look.hidden = !look.hidden;
  if (ui::menu_item("menu.fade", look.faded)) look.faded = !look.faded;
  if (ui::menu_item("menu.isolate", is_isolated(view, part_))) isolate(view, part_);
  if (ui::menu_item("menu.show_all")) show_all(view);
  if (ui::menu_item("menu.frame")) context.asks.frame_selection = true;
  if (!view.names_hidden && ui::menu_item("session.note")) context.asks.write_note = true;
  if (part_.kind == PartKind::Muscle) {
    ImGui::Separator();
    if (ui::menu_item("menu.plot", is_plotted(view, part_.index))) toggle_plot(view, part_.index);
    if (ui::menu_item("menu.attachments", view.attachments)) view.attachments = !view.attachments;
  }
  ImGui::EndPopup();
}

}  // namespace myotact::view
