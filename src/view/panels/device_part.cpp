#include "view/panels/device_part.h"

#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "view/panels/force_buttons.h"
#include "view/ui/controls.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

using messages::DevicePhase;

std::string phase_text(DevicePhase phase) {
  return ui::tr(fmt::format("devices.{}", phase_name(phase)).c_str());
}

std::string name_and_hand(const DeviceNews& device) {
  return ui::tr(device.left ? "devices.left" : "devices.right", device.name);
}

/// Drivers speak English; "hint." and their sentence is the key of its translation.
std::string hint_of(const messages::DeviceReport& report) {
  const std::string key = fmt::format("hint.{}", report.hint);
  return ui::has_text(key) ? ui::tr(key.c_str()) : report.hint;
}

/// In a frame: it is what the person has to see first.
void draw_hint(const std::string& hint) {
  const float pad = 0.4f * ImGui::GetFontSize();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::SetCursorScreenPos(ImVec2(corner.x + 2.0f * pad, corner.y + pad));
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width - 3.0f * pad);
  ImGui::TextUnformatted(hint.c_str());
  ImGui::PopTextWrapPos();
  const float low = ImGui::GetItemRectMax().y + pad;
  ui::note_control("devices.hint", hint);
  const ImU32 warning = ImGui::GetColorU32(ImGuiCol_PlotHistogramHovered);
  list.AddRect(corner, ImVec2(corner.x + width, low), warning);
  list.AddRectFilled(corner, ImVec2(corner.x + pad, low), warning);
  ImGui::SetCursorScreenPos(ImVec2(corner.x, low + pad));
}

void draw_device(const DeviceNews& device) {
  const messages::DeviceReport& report = device.report;
  std::string text = fmt::format("{}: {}", name_and_hand(device), phase_text(report.phase));
  if (report.phase == DevicePhase::Ready && report.rate_Hz > 0.0)
    text += fmt::format(", {}", ui::tr("devices.rate", report.rate_Hz));
  ui::paragraph(text);
  ui::note_control("devices.device", text);
  if (*report.hint != '\0') draw_hint(hint_of(report));
  if (report.warmth < 0.0) return;
  ui::bar(report.warmth, ui::tr("devices.warmth", 100.0 * report.warmth));
  ui::note_control("devices.warmth", fmt::format("{:.2f}", report.warmth));
}

/// The same as the toolbar's, where the eyes are when a device pulls.
void draw_stop_and_arm(PanelContext& context) {
  if (red_button("devices.stop")) context.scene.stop_forces();
  ImGui::SameLine();
  ImGui::BeginDisabled(!forces_stopped(context.frame));
  if (ui::button("devices.arm")) context.scene.enable_forces();
  ImGui::EndDisabled();
}

void draw_clutch(PanelContext& context) {
  ImGui::BeginDisabled(context.news.devices.empty());
  if (ui::hold_button("devices.clutch")) context.controls.clutch = true;
  ImGui::EndDisabled();
  if (!is_clutched(context)) return;
  ImGui::SameLine();
  ui::text("devices.clutched");
  ui::note_control("devices.clutched");
}

}  // namespace

void draw_devices(PanelContext& context) {
  ui::heading("devices.heading");
  for (const DeviceNews& device : context.news.devices) draw_device(device);
  if (context.news.devices.empty()) {
    ui::paragraph(ui::tr("devices.none"));
  } else {
    draw_stop_and_arm(context);
  }
  draw_clutch(context);
}

bool is_clutched(const PanelContext& context) {
  const std::vector<DeviceNews>& devices = context.news.devices;
  return context.controls.clutch ||
         std::any_of(devices.begin(), devices.end(), [](const DeviceNews& device) { return device.clutched; });
}

bool wants_a_person(const messages::DeviceReport& report) {
  return report.phase == DevicePhase::Lost || report.phase == DevicePhase::NeedsCalibration;
}

const char* phase_name(DevicePhase phase) {
  switch (phase) {
    case DevicePhase::Closed:
      return "closed";
    case DevicePhase::Opening:
      return "opening";
    case DevicePhase::NeedsCalibration:
      return "needs_calibration";
    case DevicePhase::Ready:
      return "ready";
    case DevicePhase::Lost:
      return "lost";
  }
  return "";
}

std::string sentence_about(const DeviceNews& device) {
  const std::string what = fmt::format("{}: {}.", name_and_hand(device), phase_text(device.report.phase));
  return *device.report.hint == '\0' ? what : fmt::format("{} {}", what, hint_of(device.report));
}

}  // namespace myotact::view
