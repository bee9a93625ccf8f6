#include "view/panels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <imgui.h>

#include "view/colour_map.h"
#include "view/joint_panel.h"
#include "view/key_bindings.h"
#include "view/tool_drawing.h"

namespace myotact::view {

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr float kPlotHeight = 74.0f;
const ImVec4 kWarning(1.0f, 0.62f, 0.2f, 1.0f);

ImVec4 colour_of(double activation) {
  const glm::vec3 c = cividis(activation);
  return {c.r, c.g, c.b, 1.0f};
}

void draw_wrapped(const std::string& text, const ImVec4& colour) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
}

bool slider(const char* label, double& value, float lowest, float highest) {
  auto number = static_cast<float>(value);
  const bool moved = ImGui::SliderFloat(label, &number, lowest, highest, "%.2f");
  if (moved) value = static_cast<double>(number);
  return moved;
}

void draw_play(bool stopped, ViewControls& controls) {
  if (ImGui::Button(controls.paused ? "Play" : "Pause")) controls.paused = !controls.paused;
  ImGui::SameLine();
  if (ImGui::Button("Step")) {
    controls.paused = true;
    ++controls.steps;
  }
  ImGui::SameLine();
  if (ImGui::Button("Reset")) ++controls.resets;
  ImGui::SameLine();
  if (ImGui::Button(stopped ? "Forces on" : "Forces off")) ++(stopped ? controls.arms : controls.stops);
  ImGui::SameLine();
  ImGui::TextDisabled("F1: keys");
}

void draw_sliders(ViewControls& controls) {
  ImGui::TextUnformatted("Activation");
  const bool flexors_moved = slider("flexors", controls.flexors, 0.0f, 1.0f);  // both are drawn, whichever moved
  if (slider("extensors", controls.extensors, 0.0f, 1.0f) || flexors_moved) {
    controls.levels_changed = true;
    controls.balance_changed = false;
  }
  ImGui::TextUnformatted("Co-contraction at zero net torque");
  const bool common_moved = slider("common", controls.common, 0.0f, 1.0f);
  if (slider("difference", controls.difference, -0.5f, 0.5f) || common_moved) {
    controls.balance_changed = true;
    controls.levels_changed = false;
  }
  ImGui::Checkbox("hold posture", &controls.hold_posture);
  ImGui::SameLine();
}

void draw_muscles(const anatomy::Specimen& specimen, const messages::SceneFrame& frame) {
  for (std::size_t m = 0; m < specimen.muscles.size() && m < frame.activations.size(); ++m) {
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, colour_of(std::max(frame.activations[m], 0.15)));
    const std::string text = fmt::format("{:.0f} %  {:.0f} N", 100.0 * frame.activations[m], frame.tensions_N[m]);
    ImGui::ProgressBar(static_cast<float>(frame.activations[m]), ImVec2(130, 0), text.c_str());
    ImGui::PopStyleColor();
    ImGui::SameLine();
    ImGui::TextUnformatted(specimen.muscles[m].name_en.c_str());
    if (ImGui::IsItemHovered()) {
      ImGui::SetTooltip("%s\nvolume %+.2f %%, smallest J %.2f", specimen.muscles[m].name_la.c_str(),
                        100.0 * (frame.volume_ratios[m] - 1.0), frame.smallest_volume_ratios[m]);
    }
  }
}

void draw_legend() {
  ImGui::TextUnformatted("activation");
  ImGui::SameLine();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  constexpr float kWidth = 160.0f;
  constexpr int kParts = 32;
  const float height = ImGui::GetTextLineHeight();
  for (int i = 0; i < kParts; ++i) {
    const float x = corner.x + kWidth * static_cast<float>(i) / kParts;
    ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(x, corner.y), ImVec2(x + kWidth / kParts, corner.y + height),
                                              ImGui::GetColorU32(colour_of((i + 0.5) / kParts)));
  }
  ImGui::Dummy(ImVec2(kWidth, height));
  ImGui::SameLine();
  ImGui::TextUnformatted("0 .. 1");
}

double force_N(const messages::ToolFrame& tool) {
  const auto& f = tool.force_world_N;
  return std::hypot(f[0], f[1], f[2]);
}

void draw_force_bars(const messages::SceneFrame& frame, const std::vector<double>& peaks_N) {
  for (std::size_t t = 0; t < frame.tools.size() && t < peaks_N.size(); ++t) {
    const messages::ToolFrame& tool = frame.tools[t];
    const char* whose = frame.tools.size() == 1 ? "" : tool.left ? "left " : "right ";
    const std::string text = fmt::format("{}force {:.2f} of {:.1f} N", whose, force_N(tool), peaks_N[t]);
    const glm::vec3 colour = tool_colour(tool);
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, ImVec4(colour.r, colour.g, colour.b, 1.0f));
    ImGui::ProgressBar(static_cast<float>(force_N(tool) / peaks_N[t]), ImVec2(-1, 0), text.c_str());
    ImGui::PopStyleColor();
  }
}

void draw_rates(const messages::SceneFrame& frame) {
  const messages::RateFrame& rates = frame.rates;
  ImGui::TextWrapped("simulation %.0f Hz, haptics %.0f Hz, %llu ticks missed, time x %.2f", rates.simulation_hz,
                     rates.haptic_hz, static_cast<unsigned long long>(rates.missed_ticks), rates.time_factor);
  double volume_error = 0.0, smallest_J = 1.0;
  for (const double ratio : frame.volume_ratios) volume_error = std::max(volume_error, std::abs(ratio - 1.0));
  for (const double ratio : frame.smallest_volume_ratios) smallest_J = std::min(smallest_J, ratio);
  ImGui::TextWrapped("residual %.1f %%, volume within %.2f %%, smallest J %.2f", 100.0 * frame.residual_share,
                     100.0 * volume_error, smallest_J);
}

void draw_help() {
  ImGui::Begin("Keys", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
  for (const KeyBinding& binding : key_bindings()) {
    ImGui::Text("%-10s %s", std::string(binding.name).c_str(), std::string(binding.what).c_str());
  }
  ImGui::Separator();
  ImGui::TextUnformatted(
      "left drag     orbit\nright drag    pan\nwheel         zoom\nCtrl + mouse  the hand; wheel: depth; G or B takes "
      "hold");
  ImGui::End();
}

void update_plots(const messages::SceneFrame& frame, PanelState& state) {
  if (state.joint < static_cast<int>(frame.joints.size())) {
    const auto& joint = frame.joints[static_cast<std::size_t>(state.joint)];
    state.angle.add(frame.time_s, joint.angle_rad * kDegrees);
    state.stiffness.add(frame.time_s, joint.stiffness_Nm_rad);
  }
  double sum_N = 0.0;
  for (const messages::ToolFrame& tool : frame.tools) sum_N += force_N(tool);
  if (!frame.tools.empty()) state.force.add(frame.time_s, sum_N);
}

}  // namespace

void draw_panels(const anatomy::Specimen& specimen, const messages::SceneFrame& frame, PanelState& state,
                 ViewControls& controls) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  update_plots(frame, state);
  ImGui::SetNextWindowPos(ImVec2(display.x - kPanelWidth, 0));
  ImGui::SetNextWindowSize(ImVec2(kPanelWidth, display.y));
  ImGui::Begin(
      "Myotact", nullptr,
      ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoTitleBar);
  const bool stopped = std::any_of(frame.tools.begin(), frame.tools.end(),
                                   [](const messages::ToolFrame& tool) { return tool.forces_stopped; });
  draw_play(stopped, controls);
  if (stopped) draw_wrapped("FORCES STOPPED. Enter, or the button, turns them on again.", kWarning);
  ImGui::Separator();
  const bool has_muscles = !specimen.muscles.empty();
  if (has_muscles) draw_sliders(controls);
  ImGui::Checkbox("gravity", &controls.gravity);
  if (!frame.notice.empty()) draw_wrapped(frame.notice, kWarning);
  ImGui::Separator();
  if (has_muscles) {
    draw_muscles(specimen, frame);
    draw_legend();
    ImGui::Separator();
  }
  const auto joint = static_cast<std::size_t>(state.joint);
  if (joint < frame.joints.size()) {
    state.angle.draw(kPlotHeight);
    state.stiffness.draw(kPlotHeight);
  }
  if (has_muscles && joint < frame.joints.size()) draw_joint(frame.joints[joint], state.readings, controls);
  if (joint < frame.joints.size() && frame.joints[joint].preview) {
    ImGui::Text("joint stiffness: %s", messages::kPreviewMark);
  }
  state.force.draw(kPlotHeight);
  draw_force_bars(frame, state.device_peaks_N);
  ImGui::Separator();
  draw_rates(frame);
  draw_wrapped(state.note, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextDisabled("Not a medical device.");
  ImGui::End();
  if (state.help) draw_help();
}

}  // namespace myotact::view
