#include <algorithm>
#include <iostream>
#include <numbers>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "app/options.h"
#include "app/stiffness_chart.h"
#include "core/error.h"
#include "core/file.h"
#include "measure/stiffness_sweep.h"
#include "messages/scene_frame.h"
#include "simulation/simulation.h"

namespace myotact::app {

int stiffness(const Options& options) {
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
