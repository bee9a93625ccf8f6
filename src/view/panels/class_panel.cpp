#include "view/panels/class_panel.h"

#include <imgui.h>

#include "view/ui/controls.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

constexpr float kHeadline = 2.0f;  // times the font
constexpr double kDegrees = 57.29577951308232;

void draw_headline(const std::string& text, const char* key) {
  ImGui::SetWindowFontScale(kHeadline);
  ImGui::TextUnformatted(text.c_str());
  ui::note_control(key, text);
  ImGui::SetWindowFontScale(1.0f);
}

}  // namespace

void draw_class_panel(PanelContext& context, const Area& scene) {
  const float gap = 0.5f * ImGui::GetFontSize();
  ImGui::SetNextWindowPos(ImVec2(scene.x + gap, scene.y + 0.5f * scene.height), 0, ImVec2(0.0f, 0.5f));
  ImGui::Begin("class", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove);
  const auto watched = static_cast<std::size_t>(context.facts.joint);
  if (watched < context.frame.joints.size()) {
    const messages::JointFrame& joint = context.frame.joints[watched];
    ui::text("class.stiffness");
    draw_headline(ui::tr("class.K", joint.stiffness_Nm_rad), "class.K");
    ImGui::TextUnformatted(ui::tr("class.angle", joint.angle_rad * kDegrees).c_str());
  }
  const std::string common = ui::tr("class.common", 100.0 * context.scene.state().common_now);
  ImGui::TextUnformatted(common.c_str());
  ui::note_control("class.common", common);
  if (ui::button("class.less")) context.asks.co_contraction_step = -kCoContractionStep;
  ImGui::SameLine();
  if (ui::button("class.more")) context.asks.co_contraction_step = kCoContractionStep;
  ImGui::SameLine();
  if (ui::button("class.leave")) context.asks.big_type = true;
  ImGui::End();
}

}  // namespace myotact::view
