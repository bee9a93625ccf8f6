#include "view/panels/class_panel.h"

#include <cmath>

#include <imgui.h>

#include "view/ui/controls.h"
#include "view/ui/font.h"
#include "view/ui/qr_code.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

constexpr double kDegrees = 57.29577951308232;

void draw_headline(const std::string& text, const char* key) {
  ui::push_type(ui::Type::Number);
  ImGui::TextUnformatted(text.c_str());
  ui::note_control(key, text);
  ImGui::PopFont();
}

/// How to join, for telephones that look at the screen: dark on light whatever the theme, with the margin that the
/// standard asks for.
void draw_way_in(const ClassNews& news) {
  constexpr int kMargin = 4;
  ImGui::Separator();
  ui::text("class.join");
  ImGui::TextUnformatted(news.join_link.c_str());
  ui::note_control("class.link", news.join_link);
  const std::string present = ui::tr("class.present", news.students, news.hands_up);
  ImGui::TextUnformatted(present.c_str());
  ui::note_control("class.present", present);
  const std::optional<QrCode> code = qr_code(news.join_link);
  if (!code) return;
  const float module = std::round(0.25f * ImGui::GetFontSize());
  const float side = module * static_cast<float>(code->width + 2 * kMargin);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(corner, ImVec2(corner.x + side, corner.y + side), IM_COL32_WHITE);
  for (int row = 0; row < code->width; ++row) {
    for (int column = 0; column < code->width; ++column) {
      if (!code->is_dark(row, column)) continue;
      const ImVec2 at(corner.x + module * static_cast<float>(column + kMargin),
                      corner.y + module * static_cast<float>(row + kMargin));
      list.AddRectFilled(at, ImVec2(at.x + module, at.y + module), IM_COL32_BLACK);
    }
  }
  ImGui::Dummy(ImVec2(side, side));
  ui::note_control("class.qr", news.join_link);
}

}  // namespace

void draw_class_panel(PanelContext& context, const Area& scene) {
  const float gap = 0.5f * ImGui::GetFontSize();
  constexpr float kAbove = 0.36f;  // the legend is below it, news above
  ImGui::SetNextWindowPos(ImVec2(scene.x + gap, scene.y + kAbove * scene.height), 0, ImVec2(0.0f, kAbove));
  ImGui::Begin("class", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoBringToFrontOnFocus);  // news has buttons, too
  const auto watched = static_cast<std::size_t>(context.facts.joint);
  if (watched < context.frame.joints.size()) {
    const messages::JointFrame& joint = context.frame.joints[watched];
    ui::text("class.stiffness");
    draw_headline(ui::tr("class.K", joint.stiffness_Nm_rad), "class.K");
    ImGui::TextUnformatted(ui::tr("class.angle", std::round(joint.angle_rad * kDegrees) + 0.0).c_str());
  }
  const std::string common = ui::tr("class.common", 100.0 * context.scene.state().common_now);
  ImGui::TextUnformatted(common.c_str());
  ui::note_control("class.common", common);
  if (ui::button("class.less")) context.asks.co_contraction_step = -kCoContractionStep;
  ImGui::SameLine();
  if (ui::button("class.more")) context.asks.co_contraction_step = kCoContractionStep;
  ImGui::SameLine();
  if (ui::button("class.leave")) context.asks.big_type = true;
  if (context.news.class_in) draw_way_in(*context.news.class_in);
  ImGui::End();
}

}  // namespace myotact::view
