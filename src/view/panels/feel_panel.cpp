#include "view/panels/feel_panel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <imgui.h>

#include "view/look/part_actions.h"
#include "view/panels/device_part.h"
#include "view/render/tool_drawing.h"
#include "view/ui/controls.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

constexpr double kPascals = 1000.0;  // a kilopascal

double norm(const std::array<double, 3>& v) {
  return std::hypot(v[0], v[1], v[2]);
}

void draw_force(const messages::ToolFrame& tool, double peak_N, bool alone) {
  const double force_N = norm(tool.force_world_N);
  const char* key = alone ? "feel.force" : tool.left ? "feel.force_left" : "feel.force_right";
  const glm::vec3 colour = tool_colour(tool);
  ImGui::PushStyleColor(ImGuiCol_PlotHistogram, ImVec4(colour.r, colour.g, colour.b, 1.0f));
  ui::bar(force_N / peak_N, ui::tr(key, force_N, peak_N));
  ImGui::PopStyleColor();
  ui::note_control(key, fmt::format("{:.3f}", force_N));
}

/// Names of the bones that move as this body.
std::string bones_of(const PanelContext& context, int body) {
  std::string names;
  for (int b = 0; b < static_cast<int>(context.specimen.bones.size()); ++b) {
    if (context.specimen.bones[static_cast<std::size_t>(b)].body != body) continue;
    if (!names.empty()) names += ", ";
    names += name_of(context.specimen, {PartKind::Bone, b}, context.view);
  }
  return names;
}

/// A device on the table is in that hand; else the mouse is, and its mode has to be set.
bool is_on_table(const PanelContext& context, const messages::ToolFrame& tool) {
  const std::vector<DeviceNews>& devices = context.news.devices;
  return std::any_of(devices.begin(), devices.end(), [&](const DeviceNews& d) { return d.left == tool.left; });
}

/// What is touched or held, in words.
void draw_touched(const PanelContext& context, const messages::ToolFrame& tool) {
  const auto name = [&](PartKind kind, int index) { return name_of(context.specimen, {kind, index}, context.view); };
  if (tool.forces_stopped) return ui::paragraph(ui::tr("feel.stopped"));
  if (tool.grabbed_line >= 0) {
    return ui::paragraph(ui::tr("feel.holds_line", name(PartKind::Muscle, tool.grabbed_line), tool.line_tension_N));
  }
  if (tool.grabbed_body >= 0) return ui::paragraph(ui::tr("feel.holds_bone"));
  if (tool.touched_muscle >= 0)
    return ui::paragraph(ui::tr("feel.touches", name(PartKind::Muscle, tool.touched_muscle)));
  const bool on_table = is_on_table(context, tool);
  if (!context.frame.springs_world_m.empty()) {
    return ui::paragraph(ui::tr(on_table ? "feel.device_on_spring" : "feel.on_spring"));
  }
  if (!tool.in_contact) {
    return ui::paragraph(ui::tr(on_table ? "feel.device_touches_nothing" : "feel.touches_nothing"));
  }
  ui::paragraph(ui::tr("feel.touches_bone", bones_of(context, tool.touched_body)));
}

/// Where the scene is simulated here: a server's hands are their own, and a recording's tools are what they were.
void draw_choice(PanelContext& context, const messages::ToolFrame& tool, bool alone) {
  constexpr std::array kShapes = {"feel.tool.ball", "feel.tool.point", "feel.tool.clamp"};  // as in ToolShape
  const messages::ChosenTools chosen = context.scene.state().tools;
  const auto hand = static_cast<std::size_t>(tool.hand);
  if (context.facts.is_served || context.facts.replay_s > 0.0 || hand >= chosen.size()) return;
  const char* key = alone ? "feel.tool" : tool.left ? "feel.tool_left" : "feel.tool_right";
  int shape = static_cast<int>(chosen.at(hand).value_or(tool.shape));
  if (ui::choice(key, shape, kShapes)) {
    context.scene.push(messages::ChooseTool{tool.hand, static_cast<messages::ToolShape>(shape)});
  }
}

struct PartOfForce {
  const char* key;
  double force_N;
};

/// The parts, the largest first.
std::array<PartOfForce, 8> parts_of(const messages::ForceParts& parts) {
  std::array all = {
      PartOfForce{"feel.part.contact", norm(parts.contact)}, PartOfForce{"feel.part.friction", norm(parts.friction)},
      PartOfForce{"feel.part.texture", norm(parts.texture)}, PartOfForce{"feel.part.line", norm(parts.line)},
      PartOfForce{"feel.part.bone", norm(parts.bone)},       PartOfForce{"feel.part.tether", norm(parts.tether)},
      PartOfForce{"feel.part.damping", norm(parts.damping)}, PartOfForce{"feel.part.limits", norm(parts.limits)}};
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.force_N > b.force_N; });
  return all;
}

/// The force in its parts: vectors that may work against each other, so that bars need not add up to the whole.
void draw_why(const messages::ToolFrame& tool) {
  constexpr double kFelt_N = 0.01;  // less is below what a finger feels
  const auto parts = parts_of(tool.parts);
  if (parts.front().force_N < kFelt_N) return ui::paragraph(ui::tr("feel.why_nothing"));
  for (const PartOfForce& part : parts) {
    if (part.force_N < kFelt_N) continue;
    const std::string text = fmt::format("{:.2f} N  {}", part.force_N, ui::tr(part.key));
    ui::bar(part.force_N / parts.front().force_N, text);
    ui::note_control(part.key, fmt::format("{:.3f}", part.force_N));
    ui::paragraph(ui::tr(fmt::format("{}.why", part.key)));
  }
}

}  // namespace

/// Pressure beside the band that is wanted: a number, a colour and a word.
void FeelPanel::draw_gauge(const messages::ToolFrame& tool) {
  const double now_kPa = pressure_Pa(tool) / kPascals;
  const bool below = now_kPa<band_low_kPa_, above = now_kPa> band_high_kPa_;
  const char* word = now_kPa == 0.0 ? "feel.band_none"
                     : below        ? "feel.band_below"
                     : above        ? "feel.band_above"
                                    : "feel.band_in";
  const double full_kPa = 2.0 * band_high_kPa_;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = 1.4f * ImGui::GetFontSize();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto x_of = [&](double pressure_kPa) {
    return corner.x + width * static_cast<float>(std::clamp(pressure_kPa / full_kPa, 0.0, 1.0));
  };
  const ImU32 in_band = IM_COL32(0, 158, 115, 255), outside = IM_COL32(213, 94, 0, 255);  // Okabe-Ito green, vermilion
  list.AddRectFilled(corner, ImVec2(corner.x + width, corner.y + height), ImGui::GetColorU32(ImGuiCol_FrameBg));
  list.AddRectFilled(corner, ImVec2(x_of(now_kPa), corner.y + height), below || above ? outside : in_band);
  list.AddRect(ImVec2(x_of(band_low_kPa_), corner.y), ImVec2(x_of(band_high_kPa_), corner.y + height),
               ImGui::GetColorU32(ImGuiCol_Text), 0.0f, 0, 2.0f);
  ImGui::Dummy(ImVec2(width, height));
  ui::note_control("feel.pressure", fmt::format("{:.2f}", now_kPa));
  ui::paragraph(ui::tr("feel.pressure", now_kPa, ui::tr(word)));
}

void FeelPanel::draw(PanelContext& context) {
  const bool on_table = !context.news.devices.empty();
  if (on_table) {
    draw_devices(context);
    ImGui::Spacing();
  }
  draw_tools(context);
  if (!on_table) draw_devices(context);  // nothing to know there
}

void FeelPanel::draw_tools(PanelContext& context) {
  const auto& tools = context.frame.tools;
  for (std::size_t t = 0; t < tools.size() && t < context.facts.device_peaks_N.size(); ++t) {
    draw_force(tools[t], context.facts.device_peaks_N[t], tools.size() == 1);
    draw_touched(context, tools[t]);
    draw_choice(context, tools[t], tools.size() == 1);
  }
  if (tools.empty()) return;
  const messages::ToolFrame& tool = tools.front();
  ui::paragraph(ui::tr("feel.scales", tool.force_scale, tool.motion_scale, 1e3 * tool.model_age_s));
  ui::heading("feel.pressure_heading");
  draw_gauge(tool);
  ui::slider("feel.band_low", band_low_kPa_, {1.0f, 100.0f}, "%.0f kPa");
  ui::slider("feel.band_high", band_high_kPa_, {1.0f, 200.0f}, "%.0f kPa");
  band_high_kPa_ = std::max(band_high_kPa_, band_low_kPa_ + 1.0);
  bool painted = context.view.colour == MuscleColour::Pressure;
  if (ui::checkbox("feel.paint", painted)) {
    context.view.colour = painted ? MuscleColour::Pressure : MuscleColour::Activation;
  }
  ImGui::SameLine();
  if (ui::button("feel.clear")) map_.clear();
  ui::heading("feel.why");
  draw_why(tool);
}

}  // namespace myotact::view
