#include "app/stiffness_chart.h"

#include <algorithm>
#include <map>
#include <numbers>

#include <fmt/format.h>

#include "core/file.h"
#include "messages/scene_frame.h"
#include "view/chart_svg.h"

namespace myotact::app {

void write_stiffness_chart(const std::vector<measure::StiffnessRow>& rows, const std::string& title,
                           const std::filesystem::path& path) {
  std::map<double, std::vector<measure::StiffnessRow>> by_angle;
  for (const auto& row : rows) by_angle[row.q_rad].push_back(row);
  const bool preview = std::any_of(rows.begin(), rows.end(), [](const auto& row) { return row.preview; });
  const std::string mark = preview ? fmt::format(": {}", messages::kPreviewMark) : "";
  view::Chart chart{title + mark, "co-contraction (activation of the weaker side)", "joint stiffness [N m/rad]", {}};
  for (const auto& [q_rad, at_angle] : by_angle) {
    const std::string where = fmt::format("q = {:.0f} deg", q_rad * 180.0 / std::numbers::pi);
    view::ChartSeries schur{"Schur complement, " + where, {}, {}};
    view::ChartSeries perturbed{"perturbed angle, " + where, {}, {}};
    view::ChartSeries line{"muscle lines alone, " + where, {}, {}};
    for (const auto& row : at_angle) {
      for (auto* series : {&schur, &perturbed, &line}) series->x.push_back(row.common);
      schur.y.push_back(row.K_schur_Nm_rad);
      perturbed.y.push_back(row.K_perturbed_Nm_rad);
      line.y.push_back(row.K_line_Nm_rad);
    }
    chart.series.insert(chart.series.end(), {schur, perturbed, line});
  }
  write_file(path, view::line_chart_svg(chart));
}

}  // namespace myotact::app
