#include "app/stiffness_answer.h"

#include <algorithm>
#include <iostream>
#include <numbers>

#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include "app/stiffness_chart.h"
#include "core/error.h"
#include "core/file.h"
#include "messages/scene_frame.h"

namespace myotact::app {

namespace {

using Rows = std::vector<measure::StiffnessRow>;

void print_table(const Options& options, const Rows& rows) {
  std::cout << (options.json ? measure::stiffness_json(rows).dump(2) + "\n" : measure::stiffness_csv(rows))
            << std::flush;
}

/// One line an angle: why the joint is as stiff as it is when the muscles work hardest.
void log_reasons(const measure::SweepPart& sweep) {
  const auto& levels = sweep.origin.grid.levels;
  const double highest = *std::max_element(levels.begin(), levels.end());
  for (const auto& row : sweep.rows) {
    if (row.common != highest) continue;
    spdlog::info("{} at {:g} deg, co-contraction {:g}: {}", row.joint, row.q_rad * 180.0 / std::numbers::pi, row.common,
                 row.why);
  }
}

/// Warns of what must not be quoted.
int status_of(const Rows& rows) {
  if (std::any_of(rows.begin(), rows.end(), [](const auto& row) { return row.preview; })) {
    spdlog::warn("these figures are a {}; set the scene's tissue to fem for ones to quote", messages::kPreviewMark);
  }
  const auto loose = std::count_if(rows.begin(), rows.end(), [](const auto& row) { return !row.held; });
  if (loose > 0)
    spdlog::warn("the muscles do not hold the joint in {} of {} rows: see the column held", loose, rows.size());
  const auto failed = std::count_if(rows.begin(), rows.end(), [](const auto& row) { return !row.converged; });
  if (failed > 0) spdlog::warn("{} of {} rows did not converge: see the column converged", failed, rows.size());
  return static_cast<int>(failed > 0 ? ExitStatus::CheckFailed : ExitStatus::Done);
}

}  // namespace

int answer_sweep(const Options& options, const measure::SweepPart& sweep) {
  const std::string& title = sweep.origin.title;
  write_file(options.out / "stiffness.csv", measure::stiffness_csv(sweep.rows));
  write_file(options.out / "stiffness.json", measure::stiffness_json(sweep.rows).dump(2) + "\n");
  write_stiffness_chart(sweep.rows, title, options.out / "stiffness.svg");
  write_stiffness_map(sweep.rows, title, options.out / "stiffness_map.svg");
  print_table(options, sweep.rows);
  log_reasons(sweep);
  return status_of(sweep.rows);
}

int answer_part(const Options& options, const measure::SweepPart& part) {
  const auto file = options.out / measure::part_file_name(part.part, part.parts);
  write_file(file, measure::part_json(part));
  print_table(options, part.rows);
  spdlog::info("part {} of {} is in {}; --merge joins all parts", part.part, part.parts, file.string());
  return status_of(part.rows);
}

}  // namespace myotact::app
