#include "view/charts/plot_record.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "core/text.h"
#include "view/charts/chart_svg.h"

namespace myotact::view {

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double size_of(const std::array<double, 3>& force_N) {
  return std::hypot(force_N[0], force_N[1], force_N[2]);
}

std::vector<double> row_of(const anatomy::Specimen& specimen, const messages::SceneFrame& frame, std::size_t joint) {
  std::vector<double> row(PlotRecord::FirstTension_N + specimen.muscles.size(), kNone);
  if (joint < frame.joints.size()) {
    row[PlotRecord::Angle_deg] = frame.joints[joint].angle_rad * kDegrees;
    row[PlotRecord::Stiffness_Nm_rad] = frame.joints[joint].stiffness_Nm_rad;
    row[PlotRecord::Torque_Nm] = frame.joints[joint].torque_Nm;
  }
  std::fill_n(row.begin() + PlotRecord::Force_N, 1 + PlotRecord::kForceParts, 0.0);
  for (const messages::ToolFrame& tool : frame.tools) {
    row[PlotRecord::Force_N] += size_of(tool.force_world_N);
    const messages::ForceParts& parts = tool.parts;
    const std::array sizes_N = {size_of(parts.contact), size_of(parts.friction), size_of(parts.texture),
                                size_of(parts.line),    size_of(parts.bone),     size_of(parts.tether),
                                size_of(parts.damping), size_of(parts.limits)};
    static_assert(sizes_N.size() == PlotRecord::kForceParts);
    for (std::size_t p = 0; p < sizes_N.size(); ++p) row[PlotRecord::FirstPart_N + p] += sizes_N[p];
  }
  const std::size_t muscles = std::min(specimen.muscles.size(), frame.tensions_N.size());
  for (std::size_t m = 0; m < muscles; ++m) row[PlotRecord::FirstTension_N + m] = frame.tensions_N[m];
  return row;
}

}  // namespace

void PlotRecord::add(const anatomy::Specimen& specimen, const messages::SceneFrame& frame, std::size_t joint) {
  if (!times_s_.empty() && frame.time_s == times_s_.back()) return;
  const std::vector<double> row = row_of(specimen, frame, joint);
  if (row.size() != columns_.size() || (!times_s_.empty() && frame.time_s < times_s_.back())) {
    times_s_.clear();
    columns_.assign(row.size(), {});
  }
  times_s_.push_back(frame.time_s);
  for (std::size_t c = 0; c < row.size(); ++c) columns_[c].push_back(row[c]);
  // Rows are given up some seconds at a time, or every picture would move all of them.
  constexpr double kSlack_s = 5.0;
  if (frame.time_s - times_s_.front() < kKept_s + kSlack_s) return;
  const auto old = static_cast<std::ptrdiff_t>(first_within(kKept_s));
  times_s_.erase(times_s_.begin(), times_s_.begin() + old);
  for (std::vector<double>& column : columns_) column.erase(column.begin(), column.begin() + old);
}

std::size_t PlotRecord::first_within(double seconds) const {
  if (times_s_.empty()) return 0;
  const auto first = std::lower_bound(times_s_.begin(), times_s_.end(), times_s_.back() - seconds);
  return static_cast<std::size_t>(first - times_s_.begin());
}

std::string csv_of(const PlotRecord& record, std::span<const PlotSheet> sheets, std::size_t first) {
  std::string text = "time_s";
  for (const PlotSheet& sheet : sheets) {
    for (const PlotSheet::Curve& curve : sheet.curves) text += fmt::format(",{}", curve.csv_name);
  }
  text += "\n";
  for (std::size_t i = first; i < record.size(); ++i) {
    text += to_text(record.times_s()[i]);
    for (const PlotSheet& sheet : sheets) {
      for (const PlotSheet::Curve& curve : sheet.curves)
        text += fmt::format(",{}", to_text(record.column(curve.column)[i]));
    }
    text += "\n";
  }
  return text;
}

std::string svg_of(const PlotRecord& record, const PlotSheet& sheet, std::size_t first, const SheetTexts& texts) {
  Chart chart{texts.title, texts.time_label, texts.label, {}};
  const auto times_s = record.times_s(first);
  for (const PlotSheet::Curve& curve : sheet.curves) {
    const auto values = record.column(curve.column, first);
    ChartSeries series{sheet.curves.size() > 1 ? curve.name : "", {}, {}};
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!std::isfinite(values[i])) continue;
      series.x.push_back(times_s[i]);
      series.y.push_back(values[i]);
    }
    chart.series.push_back(series);
  }
  return line_chart_svg(chart);
}

}  // namespace myotact::view
