#include "view/charts/plot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "view/ui/controls.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

// Okabe and Ito's palette without black, and a grey, on a dark ground in either theme: what a curve is stays what it
// was.
constexpr std::array<ImU32, 7> kCurves = {
    IM_COL32(86, 180, 233, 255),  IM_COL32(230, 159, 0, 255),  IM_COL32(0, 190, 140, 255),  IM_COL32(240, 228, 66, 255),
    IM_COL32(204, 121, 167, 255), IM_COL32(235, 120, 60, 255), IM_COL32(190, 190, 190, 255)};
constexpr ImU32 kGround = IM_COL32(24, 26, 30, 255);
constexpr ImU32 kFrame = IM_COL32(90, 95, 105, 255);
constexpr ImU32 kZero = IM_COL32(120, 125, 135, 120);
constexpr ImU32 kText = IM_COL32(205, 208, 214, 255);

struct Axes {
  ImVec2 corner, size;
  double lowest, highest, end_s, window_s;

  float x(double t) const { return corner.x + size.x * static_cast<float>(1.0 - (end_s - t) / window_s); }
  /// A curve along the edge of its range stays a little off the frame, or half of it would be cut away.
  float y(double v) const {
    constexpr float kMargin = 0.06f;
    const auto share = static_cast<float>((v - lowest) / (highest - lowest));
    return corner.y + size.y * (1.0f - kMargin - (1.0f - 2.0f * kMargin) * share);
  }
};

/// Zero is always within; at least the sheet's smallest range.
void fit_range(const PlotRecord& record, const PlotSheet& sheet, std::size_t first, Axes& axes) {
  axes.lowest = 0.0;
  axes.highest = 0.0;
  for (const PlotSheet::Curve& curve : sheet.curves) {
    for (const double v : record.column(curve.column, first)) {
      if (!std::isfinite(v)) continue;
      axes.lowest = std::min(axes.lowest, v);
      axes.highest = std::max(axes.highest, v);
    }
  }
  const double missing = std::max(sheet.smallest_range - (axes.highest - axes.lowest), 0.0);
  axes.lowest -= axes.lowest < 0.0 ? 0.5 * missing : 0.0;
  axes.highest = std::max(axes.highest, axes.lowest + sheet.smallest_range);
}

void draw_names(const PlotRecord& record, const PlotSheet& sheet) {
  ImGui::TextUnformatted(ui::tr(sheet.key.c_str()));
  for (std::size_t c = 0; c < sheet.curves.size(); ++c) {
    const PlotSheet::Curve& curve = sheet.curves[c];
    const auto values = record.column(curve.column);
    const std::string newest = values.empty() ? "-" : fmt::format("{:.3f}", values.back());
    if (sheet.curves.size() == 1 && curve.name.empty()) {
      ImGui::SameLine();
      ImGui::TextUnformatted(newest.c_str());
      continue;
    }
    const float em = ImGui::GetFontSize();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(at.x, at.y + 0.3f * em),
                                              ImVec2(at.x + 0.8f * em, at.y + 0.7f * em), kCurves[c % kCurves.size()]);
    ImGui::Dummy(ImVec2(0.8f * em, em));
    ImGui::SameLine();
    ImGui::TextUnformatted(fmt::format("{}  {}", curve.name, newest).c_str());
  }
}

void draw_curves(const PlotRecord& record, const PlotSheet& sheet, std::size_t first, const Axes& axes) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  const auto times_s = record.times_s(first);
  std::vector<ImVec2> line;
  for (std::size_t c = 0; c < sheet.curves.size(); ++c) {
    const auto values = record.column(sheet.curves[c].column, first);
    line.clear();
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!std::isfinite(values[i])) continue;
      const ImVec2 point(axes.x(times_s[i]), axes.y(values[i]));
      // Of a point that falls into the pixel of the last one nothing would be seen.
      if (line.empty() || std::abs(point.x - line.back().x) + std::abs(point.y - line.back().y) >= 0.7f ||
          i + 1 == values.size()) {
        line.push_back(point);
      }
    }
    list->AddPolyline(line.data(), static_cast<int>(line.size()), kCurves[c % kCurves.size()], ImDrawFlags_None, 2.0f);
  }
}

void draw_axes(const Axes& axes) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 end(axes.corner.x + axes.size.x, axes.corner.y + axes.size.y);
  const float gap = 0.3f * ImGui::GetFontSize(), low = end.y - ImGui::GetTextLineHeight();
  const auto write = [&](float x, float y, const std::string& text) {
    list->AddText(ImVec2(x, y), kText, text.c_str());
  };
  list->AddRect(axes.corner, end, kFrame);
  write(axes.corner.x + gap, axes.corner.y, fmt::format("{:.2f}", axes.highest));
  write(axes.corner.x + gap, low, fmt::format("{:.2f}", axes.lowest));
  const std::string now = fmt::format("{:.1f} s", axes.end_s);
  write(end.x - gap - ImGui::CalcTextSize(now.c_str()).x, low, now);
}

void read_at_cursor(const PlotRecord& record, const PlotSheet& sheet, std::size_t first, const Axes& axes) {
  const auto times_s = record.times_s(first);
  if (times_s.empty()) return;
  const double share = static_cast<double>((ImGui::GetIO().MousePos.x - axes.corner.x) / axes.size.x);
  const double at_s = axes.end_s - axes.window_s * (1.0 - share);
  const auto nearest = std::min_element(times_s.begin(), times_s.end(),
                                        [&](double a, double b) { return std::abs(a - at_s) < std::abs(b - at_s); });
  const auto i = static_cast<std::size_t>(nearest - times_s.begin());
  ImGui::GetWindowDrawList()->AddLine(ImVec2(axes.x(*nearest), axes.corner.y),
                                      ImVec2(axes.x(*nearest), axes.corner.y + axes.size.y), kFrame);
  std::string text = fmt::format("{:.2f} s", *nearest);
  for (const PlotSheet::Curve& curve : sheet.curves) {
    text +=
        fmt::format("\n{}{}{:.4f}", curve.name, curve.name.empty() ? "" : "  ", record.column(curve.column, first)[i]);
  }
  ImGui::SetTooltip("%s", text.c_str());
}

}  // namespace

void draw_plot(const PlotRecord& record, const PlotSheet& sheet, const PlotSpan& span) {
  draw_names(record, sheet);
  Axes axes{};
  fit_range(record, sheet, span.first, axes);
  axes.corner = ImGui::GetCursorScreenPos();
  axes.size = ImVec2(std::max(ImGui::GetContentRegionAvail().x, 1.0f), std::max(span.height, 1.0f));
  axes.end_s = record.size() == 0 ? 0.0 : record.times_s().back();
  axes.window_s = span.window_s;
  ImGui::InvisibleButton(sheet.key.c_str(), axes.size);
  ui::note_control(sheet.key.c_str(), fmt::format("{}", sheet.curves.size()));
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 end(axes.corner.x + axes.size.x, axes.corner.y + axes.size.y);
  list->AddRectFilled(axes.corner, end, kGround);
  list->AddLine(ImVec2(axes.corner.x, axes.y(0.0)), ImVec2(end.x, axes.y(0.0)), kZero);
  list->PushClipRect(axes.corner, end, true);
  draw_curves(record, sheet, span.first, axes);
  list->PopClipRect();
  draw_axes(axes);
  if (ImGui::IsItemHovered()) read_at_cursor(record, sheet, span.first, axes);
}

}  // namespace myotact::view
