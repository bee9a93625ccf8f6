#include "app/stiffness_chart.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <fmt/format.h>

#include "core/file.h"
#include "messages/scene_frame.h"
#include "view/charts/chart_svg.h"
#include "view/charts/map_svg.h"

namespace myotact::app {

namespace {

using Rows = std::vector<measure::StiffnessRow>;

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr const char* kLevelLabel = "co-contraction (activation of the weaker side)";

std::string marked(const std::string& title, const Rows& rows) {
  const bool preview = std::any_of(rows.begin(), rows.end(), [](const auto& row) { return row.preview; });
  return preview ? fmt::format("{}: {}", title, messages::kPreviewMark) : title;
}

/// Rows of one angle each, by rising level.
std::map<double, Rows> rows_by_angle(const Rows& rows) {
  std::map<double, Rows> by_angle;
  for (const auto& row : rows) by_angle[row.q_rad].push_back(row);
  for (auto& [q_rad, at_angle] : by_angle) {
    std::stable_sort(at_angle.begin(), at_angle.end(),
                     [](const auto& a, const auto& b) { return a.common < b.common; });
  }
  return by_angle;
}

void add_angle(const Rows& rows, int colour, view::Chart& chart) {
  view::ChartSeries schur{fmt::format("q = {:.4g} deg", rows.front().q_rad * kDegrees), {}, {}};
  view::ChartSeries perturbed{"", {}, {}, view::Stroke::Rings};
  view::ChartSeries line{"", {}, {}, view::Stroke::Dashed};
  for (const auto& row : rows) {
    for (auto* series : {&schur, &perturbed, &line}) series->x.push_back(row.common);
    schur.y.push_back(row.K_schur_Nm_rad);
    const double known =
        row.held && row.converged ? 1.0 : std::nan("");  // a band round nothing to quote hides the rest
    schur.low.push_back(known * row.K_low_Nm_rad);
    schur.high.push_back(known * row.K_high_Nm_rad);
    perturbed.y.push_back(row.K_perturbed_Nm_rad);
    line.y.push_back(row.K_line_Nm_rad);
  }
  for (auto* series : {&schur, &perturbed, &line}) {
    series->colour = colour;
    chart.series.push_back(*series);
  }
}

}  // namespace

void write_stiffness_chart(const Rows& rows, const std::string& title, const std::filesystem::path& path) {
  const auto by_angle = rows_by_angle(rows);
  view::Chart chart{marked(title, rows), kLevelLabel, "joint stiffness [N m/rad]", {}};
  const std::size_t shown = std::min<std::size_t>(by_angle.size(), view::kChartColours);
  std::size_t place = 0, drawn = 0;
  for (const auto& [q_rad, at_angle] : by_angle) {  // the first, the last and evenly between them
    const std::size_t wanted = shown > 1 ? drawn * (by_angle.size() - 1) / (shown - 1) : 0;
    if (place++ == wanted && drawn < shown) add_angle(at_angle, static_cast<int>(drawn++), chart);
  }
  if (shown < by_angle.size()) chart.title += fmt::format(" ({} of {} angles)", shown, by_angle.size());
  const auto explain = [&](const char* text, view::Stroke stroke, std::vector<double> band) {
    chart.series.push_back({text, {}, {}, stroke, band, band, view::kInk});
  };
  explain("Schur complement, band: anatomy", view::Stroke::Line, {0.0});
  explain("perturbed angle", view::Stroke::Rings, {});
  explain("muscle lines alone", view::Stroke::Dashed, {});
  write_file(path, view::line_chart_svg(chart));
}

void write_stiffness_map(const Rows& rows, const std::string& title, const std::filesystem::path& path) {
  view::ValueMap map;
  map.title = marked(title, rows);
  map.x_label = kLevelLabel;
  map.y_label = "joint angle q [degrees, flexion positive]";
  map.value_label = "joint stiffness K [N m/rad]";
  map.hatch_label = "unstable: K < 0";
  map.cross_label = "static solve did not converge";
  map.ring_label = "muscles do not hold the joint";
  map.zero_label = "K = 0";
  std::map<double, std::map<double, const measure::StiffnessRow*>> grid;  // a cell asked for twice is drawn once
  for (const auto& row : rows) grid[row.q_rad][row.common] = &row;
  for (const auto& [common, row] : grid.begin()->second) map.x.push_back(common);
  for (const auto& [q_rad, at_angle] : grid) {
    map.y.push_back(q_rad * kDegrees);
    for (const auto& [common, row] : at_angle) {
      map.cells.push_back({row->K_schur_Nm_rad, row->K_schur_Nm_rad < 0.0, !row->converged, !row->held});
    }
  }
  write_file(path, view::value_map_svg(map));
}

}  // namespace myotact::app
