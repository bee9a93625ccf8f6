#include <algorithm>
#include <iostream>
#include <numbers>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "app/options.h"
#include "app/stiffness_chart.h"
#include "core/error.h"
#include "core/file.h"
#include "measure/line/line_stiffness.h"
#include "measure/stiffness_sweep.h"
#include "messages/scene_frame.h"
#include "simulation/simulation.h"
#include "view/chart_svg.h"

namespace myotact::app {

namespace {

void write_line_chart(const measure::LineModel& model, const std::vector<measure::LineRow>& rows,
                      const std::filesystem::path& path) {
  view::Chart chart{
      model.joint.name, "co-contraction (activation of the weaker side)", "joint stiffness [N m/rad]", {}};
  for (const measure::LineRow& row : rows) {
    const std::string where = fmt::format("q = {:.0f} deg", row.q_rad * 180.0 / std::numbers::pi);
    if (chart.series.empty() || chart.series.back().name != where) chart.series.push_back({where, {}, {}});
    chart.series.back().x.push_back(row.level);
    chart.series.back().y.push_back(row.state.all().stiffness_Nm_rad());
  }
  write_file(path, view::line_chart_svg(chart));
}

/// Of a line model, which needs no specimen and brings its own angles and levels.
int line_model_stiffness(const Options& options) {
  if (!options.set.empty() || !options.devices.empty()) {
    throw Error(ExitStatus::Usage, options.scene + ": is a line model, which takes no --set and no --device; edit it");
  }
  if (options.angles_deg != Options{}.angles_deg || options.levels != Options{}.levels) {
    throw Error(ExitStatus::Usage,
                options.scene +
                    ": is a line model, which brings its own q_rad and levels; edit it instead of giving "
                    "--angles or --levels");
  }
  const measure::LineModel model = measure::load_line_model(options.scene);
  make_writable_folder(options.out);
  const std::vector<measure::LineRow> rows = measure::line_stiffness(model);
  const std::string csv = measure::line_stiffness_csv(model, rows);
  write_file(options.out / "line_stiffness.csv", csv);
  write_line_chart(model, rows, options.out / "line_stiffness.svg");
  std::cout << (options.json ? measure::line_stiffness_json(model, rows) : csv) << std::flush;
  if (std::any_of(rows.begin(), rows.end(), [](const auto& row) { return !row.balance.held; })) {
    spdlog::warn(
        "some rows are not in balance (held 0): the passive pull of one side beats the other at its strongest");
  }
  const bool agree = std::all_of(rows.begin(), rows.end(), measure::agrees);
  if (!agree)
    spdlog::warn("K and K_perturbed differ: a path begins to wrap, or a muscle goes slack, at one of the angles");
  return static_cast<int>(agree ? ExitStatus::Done : ExitStatus::CheckFailed);
}

}  // namespace

int stiffness(const Options& options) {
  if (measure::is_line_model(options.scene)) return line_model_stiffness(options);
  const scene::Scene scene = scene_of(options);
  make_writable_folder(options.out);
  simulation::Simulation simulation(scene.specimen, scene.settings);
  std::vector<measure::StiffnessRow> rows;
  for (const double angle_deg : options.angles_deg) {
    const auto part = measure::sweep_stiffness(scene, simulation, angle_deg * std::numbers::pi / 180.0, options.levels);
    rows.insert(rows.end(), part.begin(), part.end());
  }
  write_file(options.out / "stiffness.csv", measure::stiffness_csv(rows));
  write_stiffness_chart(rows, scene.title, options.out / "stiffness.svg");
  std::cout << (options.json ? measure::stiffness_json(rows) : measure::stiffness_csv(rows)) << std::flush;
  if (std::any_of(rows.begin(), rows.end(), [](const auto& row) { return row.preview; })) {
    spdlog::warn("these figures are a {}; set the scene's tissue to fem for ones to quote", messages::kPreviewMark);
  }
  const bool converged = std::all_of(rows.begin(), rows.end(), [](const auto& row) { return row.converged; });
  if (!converged) spdlog::warn("some rows did not converge: see the column converged");
  return static_cast<int>(converged ? ExitStatus::Done : ExitStatus::CheckFailed);
}

}  // namespace myotact::app
