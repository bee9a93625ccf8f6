#include "measure/fidelity/layer_fidelity.h"

#include <iostream>
#include <map>
#include <optional>

#include "app/options.h"
#include "core/error.h"
#include "core/file.h"
#include "view/charts/chart_svg.h"

namespace myotact::app {

namespace {

constexpr std::size_t kEvery = 4;  // ticks: 4 ms between two points of the chart, a quarter of an engine's step

/// One chart an engine: the force of each of its runs.
void write_charts(const measure::LayerFidelity& fidelity, const std::filesystem::path& folder) {
  std::map<std::string, view::Chart> charts;
  for (const measure::LayerFidelity::Trace& trace : fidelity.traces) {
    view::Chart& chart = charts[trace.engine];
    chart.title = trace.engine + ", " + fidelity.title;
    chart.x_label = "time [s]";
    chart.y_label = "force on the hand [N]";
    view::ChartSeries series{trace.name, {}, {}};
    for (std::size_t i = 0; i < trace.ticks.size(); i += kEvery) {
      series.x.push_back(trace.ticks[i].t_s);
      series.y.push_back(trace.ticks[i].force_N.norm());
    }
    chart.series.push_back(std::move(series));
  }
  for (const auto& [engine, chart] : charts) write_file(folder / ("force_" + engine + ".svg"), line_chart_svg(chart));
}

}  // namespace

std::optional<int> layer_fidelity(const Options& options) {
  const bool of_layer = options.scene == "plane" || options.scene == "plate";
  if (!of_layer) return std::nullopt;
  const scene::Scene scene = scene_of(options);
  make_writable_folder(options.out);
  const auto effort = options.brief ? measure::Effort::Short : measure::Effort::Full;
  const measure::LayerFidelity found =
      options.scene == "plane" ? measure::measure_plane(scene, effort) : measure::measure_plate(scene, effort);
  const std::string json = measure::layer_json(found);
  write_file(options.out / "fidelity.json", json);
  write_file(options.out / "force.csv", measure::layer_csv(found));
  write_charts(found, options.out);
  std::cout << (options.json ? json : measure::layer_text(found)) << std::flush;
  return static_cast<int>(found.passed() ? ExitStatus::Done : ExitStatus::CheckFailed);
}

}  // namespace myotact::app
