#include "view/window/first_steps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <imgui.h>

#include "view/overlay/seen_parts.h"
#include "view/ui/controls.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

constexpr double kContracted = 0.5;  // common level from which on the joint is felt to be another

bool touches_muscle(const PanelContext& context) {
  return std::any_of(context.frame.tools.begin(), context.frame.tools.end(),
                     [](const messages::ToolFrame& tool) { return tool.in_contact && tool.touched_muscle >= 0; });
}

/// Waxes and wanes once a second, so that it is seen beside all that stands still.
float pulse() {
  return 0.5f + 0.5f * static_cast<float>(std::sin(6.2831853 * ImGui::GetTime()));
}

void glow_round(const ImVec2& low, const ImVec2& high) {
  const float gap = 3.0f + 4.0f * pulse();
  ImGui::GetForegroundDrawList()->AddRect(ImVec2(low.x - gap, low.y - gap), ImVec2(high.x + gap, high.y + gap),
                                          ImGui::GetColorU32(ImGuiCol_PlotHistogram), 6.0f, 0, 3.0f);
}

/// False where no such control is shown.
bool glow_on_control(const char* key) {
  const ui::ControlPlace* found = ui::find_control(key);
  if (found == nullptr) return false;
  glow_round(ImVec2(found->x, found->y), ImVec2(found->x + found->width, found->y + found->height));
  return true;
}

}  // namespace

/// Where there is nothing to contract, the second and third step have no point.
void FirstSteps::go_on(const PanelContext& context) {
  const bool touches = touches_muscle(context);
  was_let_go_ = was_let_go_ || !touches;
  const Step before = step_;
  if (step_ == Step::Press && touches) step_ = context.facts.presets.empty() ? Step::Learn : Step::Contract;
  const bool contracted = step_ == Step::Contract && context.scene.state().common_now >= kContracted;
  settles_ = contracted && !stands_stiffer(context);
  if (contracted && !settles_) step_ = Step::PressAgain;
  if (step_ == Step::PressAgain && touches && was_let_go_) step_ = Step::Learn;
  if (step_ != before) was_let_go_ = !touches;
  const auto joint = static_cast<std::size_t>(context.facts.joint);
  const bool is_relaxed = context.scene.state().common_now < 0.1;
  if (!is_relaxed || joint >= context.frame.joints.size()) return;
  angle_rad_ = context.frame.joints[joint].angle_rad;
  K_Nm_rad_ = context.frame.joints[joint].stiffness_Nm_rad;
}

void FirstSteps::enter_another_scene() {
  if (step_ == Step::PressAgain) step_ = Step::Contract;
  began_ = was_let_go_ = settles_ = false;
  angle_rad_ = K_Nm_rad_ = 0.0;
}

/// Whether what the next sentence says is seen: the joint stands where it stood, and is stiffer.
bool FirstSteps::stands_stiffer(const PanelContext& context) const {
  constexpr double kStill_rad = 0.0175;  // a degree, as much as is seen on the limb
  const auto joint = static_cast<std::size_t>(context.facts.joint);
  if (joint >= context.frame.joints.size()) return false;
  const messages::JointFrame& now = context.frame.joints[joint];
  return std::abs(now.angle_rad - angle_rad_) < kStill_rad && now.stiffness_Nm_rad > 1.5 * K_Nm_rad_;
}

void FirstSteps::glow_on_muscle(const PanelContext& context, const Area& scene, const std::vector<bool>& superficial) {
  constexpr double kEvery_s = 0.5;  // the coarse picture takes some milliseconds
  if (ImGui::GetTime() > looked_s_ + kEvery_s) {
    looked_s_ = ImGui::GetTime();
    const SeenLimb seen = seen_parts(context.specimen, context.frame, context.view, superficial,
                                     scene.width / std::max(scene.height, 1.0f));
    float largest = 0.0f;
    for (const SeenPart& part : seen.parts) {
      if (part.part.kind != PartKind::Muscle || part.share <= largest) continue;
      largest = part.share;
      x_ = part.place.x;
      y_ = part.place.y;
    }
  }
  const ImVec2 middle(scene.x + x_ * scene.width, scene.y + y_ * scene.height);
  const float radius = ImGui::GetFontSize() * (0.9f + 0.4f * pulse());
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  list.AddCircle(middle, radius, IM_COL32(0, 0, 0, 255), 0, 6.0f);
  list.AddCircle(middle, radius, IM_COL32(255, 255, 255, 255), 0, 3.0f);
  ui::note_place({"first.place", "", middle.x - radius, middle.y - radius, 2.0f * radius, 2.0f * radius});
}

bool FirstSteps::draw(PanelContext& context, const Area& scene, const std::vector<bool>& superficial) {
  if (!began_) context.asks.pointer_mode = PointerMode::Touch;  // a press is felt, not only selected
  began_ = true;
  go_on(context);
  const bool presses = step_ == Step::Press || step_ == Step::PressAgain;
  if (presses && !touches_muscle(context)) glow_on_muscle(context, scene, superficial);
  if (step_ == Step::Contract) {
    for (const char* key : {"demonstrate.preset.firm", "tasks.demonstrate", "fold.tasks"}) {
      if (glow_on_control(key)) break;
    }
  }
  if (step_ == Step::Learn) glow_on_control("tasks.learn");
  // Beside the limb, above the scale bar, and off the legend.
  const float em = ImGui::GetFontSize(), width = std::min(17.0f * em, scene.width - em);
  ImGui::SetNextWindowPos(ImVec2(scene.x + scene.width - 0.5f * em, scene.y + scene.height - 4.5f * em), 0,
                          ImVec2(1.0f, 1.0f));
  ImGui::SetNextWindowSize(ImVec2(width, 0.0f));
  ImGui::SetNextWindowBgAlpha(0.95f);
  ImGui::Begin("first_steps", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  constexpr std::array kSentences = {"first.press", "first.contract", "first.press_again", "first.learn"};
  const char* sentence = settles_ ? "first.settles" : kSentences[static_cast<std::size_t>(step_)];
  ui::paragraph(ui::tr(sentence));
  ui::note_control(sentence);
  const bool over = ui::button(step_ == Step::Learn ? "first.done" : "first.skip");
  ImGui::End();
  return over;
}

}  // namespace myotact::view
