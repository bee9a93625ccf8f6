#include "view/panels/demonstrate_panel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include "view/ui/controls.h"
#include "view/ui/retold.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

const ImVec4 kStiffens(0.3f, 0.55f, 0.85f, 1.0f), kSoftens(0.85f, 0.45f, 0.2f, 1.0f);

void draw_sliders(SceneControls& scene) {
  messages::ControlState now = scene.state();
  ui::text("demonstrate.levels");
  const bool flexors_moved = ui::slider("demonstrate.flexors", now.flexors, {0.0f, 1.0f});  // both are drawn
  if (ui::slider("demonstrate.extensors", now.extensors, {0.0f, 1.0f}) || flexors_moved) {
    scene.push(messages::SetLevels{now.flexors, now.extensors});
  }
  ui::text("demonstrate.balance");
  const bool common_moved = ui::slider("demonstrate.common", now.common, {0.0f, 1.0f});
  if (ui::slider("demonstrate.difference", now.difference, {-0.5f, 0.5f}) || common_moved) {
    scene.push(messages::CoContract{now.common, now.difference});
  }
  if (ui::checkbox("demonstrate.hold_posture", now.hold_posture)) scene.push(messages::HoldPosture{now.hold_posture});
}

struct StiffnessShare {
  const char* key;  // of its name
  double K_Nm_rad;
};

/// A bar to the right of the middle for what stiffens, to the left for what softens.
void draw_part(const StiffnessShare& part, double largest_Nm_rad) {
  const float width = 10.0f * ImGui::GetFontSize();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetTextLineHeight();
  const float middle = corner.x + 0.5f * width;
  const float end = middle + 0.5f * width * static_cast<float>(part.K_Nm_rad / largest_Nm_rad);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(ImVec2(std::min(middle, end), corner.y + 2.0f),
                      ImVec2(std::max(middle, end), corner.y + height - 2.0f),
                      ImGui::GetColorU32(part.K_Nm_rad < 0.0 ? kSoftens : kStiffens));
  list->AddLine(ImVec2(middle, corner.y), ImVec2(middle, corner.y + height), ImGui::GetColorU32(ImGuiCol_TextDisabled));
  ImGui::Dummy(ImVec2(width, height));
  ImGui::SameLine();
  ImGui::Text("%+7.2f %s", part.K_Nm_rad, ui::tr(part.key));
}

/// Its outcome, or that it runs: the limb hardly moves, and the last outcome is of another state.
void draw_shove(PanelContext& context, std::optional<double>& began_s) {
  constexpr double kLasts_s = 4.2;  // simulated: a slow push, then a stroke
  const double now_s = context.frame.time_s;
  if (ui::button("demonstrate.shove")) {
    context.scene.push(messages::TestShove{});
    began_s = now_s;
  }
  if (began_s && (now_s < *began_s || now_s > *began_s + kLasts_s)) began_s.reset();
  if (began_s) return ui::paragraph(ui::tr("demonstrate.shove_runs"));
  if (!context.readings.shove.empty()) ui::paragraph(ui::retold(context.readings.shove));
}

/// What K is made of; the bars add up to it. Finite elements do not part their own stiffness as lines do: what they add
/// to the lines' is one part.
void draw_parts(const messages::JointFrame& joint) {
  StiffnessShare muscle{"demonstrate.K_muscle", 0.0}, geometry{"demonstrate.K_geometry", 0.0};
  for (const messages::MuscleJointFrame& part : joint.muscles) {
    muscle.K_Nm_rad += part.line_muscle_Nm_rad;
    geometry.K_Nm_rad += part.line_geometry_Nm_rad;
  }
  const StiffnessShare contact{"demonstrate.K_contact", joint.contact_Nm_rad};
  const StiffnessShare passive{"demonstrate.K_passive", joint.passive_Nm_rad};
  const double others_Nm_rad = muscle.K_Nm_rad + geometry.K_Nm_rad + contact.K_Nm_rad + passive.K_Nm_rad;
  const StiffnessShare bulk{"demonstrate.K_bulk", joint.stiffness_Nm_rad - others_Nm_rad};
  const std::array parts = {muscle, geometry, bulk, contact, passive};
  double largest_Nm_rad = 1e-3;
  for (const StiffnessShare& part : parts) largest_Nm_rad = std::max(largest_Nm_rad, std::abs(part.K_Nm_rad));
  for (const StiffnessShare& part : parts) draw_part(part, largest_Nm_rad);
}

void draw_joint(PanelContext& context, std::optional<double>& shove_began_s) {
  const auto& joint = context.frame.joints[static_cast<std::size_t>(context.facts.joint)];
  const JointReadings& readings = context.readings;
  draw_parts(joint);
  if (joint.preview) ui::paragraph(ui::tr("demonstrate.preview"));
  if (!readings.why.empty()) ui::paragraph(ui::retold(readings.why));
  draw_shove(context, shove_began_s);
}

/// Another scene, or other tissue: built beside, while this one goes on.
void draw_scene_choice(PanelContext& context) {
  constexpr float kWidth_em = 7.6f;  // both in one row, with their names in any language
  const SceneFacts& facts = context.facts;
  ImGui::BeginDisabled(context.news.opening);
  std::vector<const char*> scenes;
  for (const std::string& name : facts.scenes) scenes.push_back(name.c_str());
  const auto found = std::find(facts.scenes.begin(), facts.scenes.end(), facts.name);
  int scene = found == facts.scenes.end() ? -1 : static_cast<int>(found - facts.scenes.begin());
  ImGui::SetNextItemWidth(kWidth_em * ImGui::GetFontSize());
  if (ui::choice("demonstrate.scene", scene, scenes)) {
    context.asks.wish = SceneWish{facts.scenes[static_cast<std::size_t>(scene)], facts.tissue, {}};
  }
  constexpr std::array kTissues = {"fem", "line", "mass_spring", "rigid"};
  constexpr std::array kTexts = {"demonstrate.tissue.fem", "demonstrate.tissue.line", "demonstrate.tissue.mass_spring",
                                 "demonstrate.tissue.rigid"};
  const auto* now = std::find(kTissues.begin(), kTissues.end(), facts.tissue);
  int tissue = now == kTissues.end() ? 0 : static_cast<int>(now - kTissues.begin());
  ImGui::SameLine();
  ImGui::SetNextItemWidth(kWidth_em * ImGui::GetFontSize());
  if (ui::choice("demonstrate.tissue", tissue, kTexts)) {
    context.asks.wish = SceneWish{facts.file, kTissues[static_cast<std::size_t>(tissue)], {}};
  }
  ImGui::EndDisabled();
}

/// Same picture, different feel: two states to switch between.
void draw_stored(SceneControls& scene, KeptStates& stored) {
  constexpr std::array kStore = {"demonstrate.store_a", "demonstrate.store_b"};
  constexpr std::array kShow = {"demonstrate.show_a", "demonstrate.show_b"};
  for (std::size_t i = 0; i < stored.size(); ++i) {
    if (i > 0) ImGui::SameLine();
    const SceneState now = scene_state_of(scene.state());
    if (ui::button(kStore[i])) stored[i] = now;
    ImGui::SameLine();
    ImGui::BeginDisabled(!stored[i]);
    const bool on = stored[i] && orders_between(now, *stored[i]).empty();
    if (ui::toggle_button(kShow[i], on)) scene.restore(*stored[i]);
    ImGui::EndDisabled();
  }
}

/// Ready states that show something, by the joint; they break into rows.
void draw_presets(SceneControls& scene, const std::vector<Preset>& presets) {
  const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
  const ImGuiStyle& style = ImGui::GetStyle();
  for (std::size_t i = 0; i < presets.size(); ++i) {
    const Preset& preset = presets[i];
    const std::string text_key = fmt::format("demonstrate.preset.{}", preset.name);
    const std::string& key = ui::has_text(text_key) ? text_key : preset.name;
    const float width = ImGui::CalcTextSize(ui::tr(key)).x + 2.0f * style.FramePadding.x;
    if (i > 0 && ImGui::GetItemRectMax().x + style.ItemSpacing.x + width < right) ImGui::SameLine();
    const messages::ControlState& now = scene.state();
    const bool on = now.drive == Drive::Balance && now.common == preset.common && now.difference == preset.difference;
    if (!ui::toggle_button(key.c_str(), on)) continue;
    scene.push(messages::CoContract{preset.common, preset.difference});
    scene.push(messages::HoldPosture{preset.difference == 0.0});
  }
}

}  // namespace

bool DemonstratePanel::feel_other(SceneControls& scene) {
  const bool at_a = stored_[0] && orders_between(scene_state_of(scene.state()), *stored_[0]).empty();
  const std::optional<SceneState>& other = stored_[at_a ? 1 : 0];
  if (other) scene.restore(*other);
  return other.has_value();
}

void DemonstratePanel::observe(const PanelContext& context) {
  const auto joint = static_cast<std::size_t>(context.facts.joint);
  const auto& joints = context.frame.joints;
  if (joint < joints.size()) gauge_.note(context.frame.time_s, joints[joint].stiffness_Nm_rad);
}

void DemonstratePanel::draw(PanelContext& context) {
  draw_scene_choice(context);
  context.asks.big_type = ui::button("comfort.big_type") || context.asks.big_type;
  const bool has_muscles = !context.specimen.muscles.empty();
  const bool has_joint = has_muscles && context.facts.joint < static_cast<int>(context.frame.joints.size());
  if (has_joint) {
    const auto& joint = context.frame.joints[static_cast<std::size_t>(context.facts.joint)];
    gauge_.draw(joint, context.readings);
  }
  if (context.specimen.muscles.size() > 1) {
    ui::heading("demonstrate.presets");
    draw_presets(context.scene, context.facts.presets);
    draw_stored(context.scene, stored_);
    ui::heading("demonstrate.bench");
  }
  if (has_muscles) draw_sliders(context.scene);
  bool gravity = context.scene.state().gravity;
  if (has_muscles) ImGui::SameLine();
  if (ui::checkbox("demonstrate.gravity", gravity)) context.scene.push(messages::SetGravity{gravity});
  ImGui::Separator();
  if (has_joint) draw_joint(context, shove_began_s_);
}

}  // namespace myotact::view
