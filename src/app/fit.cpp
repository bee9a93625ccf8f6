#include "app/fit.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <numeric>

#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include "app/interruption.h"
#include "core/error.h"
#include "core/file.h"
#include "measure/fit/fit_answer.h"
#include "view/charts/chart_svg.h"

namespace myotact::app {

namespace {

/// A signal came: the fit ends where it is, and nothing has been written.
struct FitStopped {
  int status = 0;
};

/// What is drawn of one curve, by rising x.
void add_curve(const measure::FitCurve& curve, const std::vector<double>& fitted, int colour,
               std::array<view::Chart, 2>& charts) {
  std::vector<std::size_t> order(curve.x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return curve.x[a] < curve.x[b]; });
  const std::string name = std::filesystem::path(curve.file).stem().string();
  view::ChartSeries measured{name, {}, {}, view::Stroke::Rings}, line{"", {}, {}, view::Stroke::Dashed},
      residual{"", {}, {}, view::Stroke::Rings};
  for (auto* series : {&measured, &line, &residual}) series->colour = colour;
  for (const std::size_t i : order) {
    for (auto* series : {&measured, &line, &residual}) series->x.push_back(curve.x[i]);
    measured.y.push_back(curve.y[i]);
    line.y.push_back(fitted[i]);
    residual.y.push_back(fitted[i] - curve.y[i]);
  }
  charts[0].series.push_back(measured);
  charts[0].series.push_back(line);
  charts[1].series.push_back(residual);
}

/// Two charts under each other: measured rings with fitted dashes, and what is between them.
std::string chart_of(const measure::FitProblem& problem, const measure::FitAnswer& answer) {
  const measure::FitCurve& first = problem.curves.front();
  std::array<view::Chart, 2> charts = {
      view::Chart{problem.title + ": rings measured, dashes fitted", first.x_name, first.y_name, {}, false},
      view::Chart{"Residuals", first.x_name, "fitted - measured, " + first.y_name, {}, false}};
  auto begin = answer.fitted.begin();
  for (std::size_t c = 0; c < problem.curves.size(); ++c) {
    const auto end = begin + static_cast<std::ptrdiff_t>(problem.curves[c].y.size());
    add_curve(problem.curves[c], {begin, end}, static_cast<int>(c), charts);
    begin = end;
  }
  return view::stacked_svg({view::line_chart_svg(charts[0]), view::line_chart_svg(charts[1])});
}

}  // namespace

int fit(const Options& options) {
  watch_for_interruption();
  try {
    const measure::FitProblem problem = measure::load_fit(options.file);
    make_writable_folder(options.out);
    const measure::FitAnswer answer = measure::fit(problem, [] {
      if (const int status = interruption(); status != 0) throw FitStopped{status};
    });
    const std::string json = measure::fit_json(problem, answer).dump(2) + "\n";
    write_file(options.out / "fit.json", json);
    write_file(options.out / "fit.csv", measure::fit_csv(problem, answer));
    write_file(options.out / "fit.svg", chart_of(problem, answer));
    std::cout << (options.json ? json : measure::fit_text(problem, answer)) << std::flush;
    for (const std::string& warning : answer.warnings) spdlog::warn("{}", warning);
    return static_cast<int>(answer.fit.converged ? ExitStatus::Done : ExitStatus::CheckFailed);
  } catch (const FitStopped& stopped) {
    return stopped.status;
  }
}

}  // namespace myotact::app
