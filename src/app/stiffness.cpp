#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "app/equipment.h"
#include "app/interruption.h"
#include "app/options.h"
#include "app/progress.h"
#include "app/shard.h"
#include "app/stiffness_answer.h"
#include "core/error.h"
#include "core/file.h"
#include "core/number_list.h"
#include "core/text.h"
#include "measure/line/line_stiffness.h"
#include "measure/stiffness_band.h"
#include "measure/stiffness_part.h"
#include "view/charts/chart_svg.h"

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
  if (!options.set.empty() || !options.devices.empty() || options.joint || !options.shard.empty()) {
    throw Error(ExitStatus::Usage,
                options.scene + ": is a line model, which takes no --set, --device, --joint or --shard; edit it");
  }
  if (options.angles != Options{}.angles || options.levels != Options{}.levels) {
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

constexpr double kRadians = std::numbers::pi / 180.0;

/// The scene with the co-contraction of the joint that is asked for.
scene::Scene scene_to_sweep(const Options& options) {
  refuse_equipment(options, "no hand takes part in a measurement; leave it out");
  scene::Scene scene = scene_of(options);
  if (scene.specimen.muscles.empty()) {
    throw bad_data(scene.name, "/specimen", "has no muscles that could stiffen a joint; name a limb, such as elbow");
  }
  if (options.joint) scene.co_contraction = scene::co_contraction_of(scene, *options.joint);
  if (!scene.co_contraction) {
    throw bad_data(scene.name, "/co_contraction",
                   "is missing; add it to the scene, or name a joint of the specimen with --joint");
  }
  return scene;
}

/// The angles asked for, else the one at which the scene has the joint. Those that the joint cannot take are named and
/// left out, so that one range serves several joints.
std::vector<double> angles_of(const Options& options, const anatomy::Joint& joint, double scene_angle_rad) {
  constexpr double kRounding_rad = 1e-9;  // the range's ends are typed in degrees with a few digits
  if (options.angles.empty()) return {scene_angle_rad};
  const auto [lowest, highest] = joint.range_rad[0];
  std::vector<double> angles_rad;
  std::vector<std::string> outside;
  for (const double angle_deg : parse_number_list("--angles", options.angles)) {
    const double q_rad = angle_deg * kRadians;
    const bool possible = q_rad >= lowest - kRounding_rad && q_rad <= highest + kRounding_rad;
    if (possible) angles_rad.push_back(q_rad);
    if (!possible) outside.push_back(to_text(angle_deg));
  }
  const std::string problem = fmt::format("--angles: {} is outside the range of the joint {}, {:.2f} .. {:.2f} degrees",
                                          join(outside), joint.key, lowest / kRadians, highest / kRadians);
  if (angles_rad.empty()) throw Error(ExitStatus::Usage, problem);
  if (!outside.empty()) spdlog::warn("{}; left out", problem);
  return angles_rad;
}

int sweep(const Options& options) {
  const scene::Scene scene = scene_to_sweep(options);
  const anatomy::Joint& joint = scene.specimen.joints[static_cast<std::size_t>(scene.co_contraction->joint)];
  const Shard shard = shard_of(options.shard, measure::kMostParts);
  const double scene_angle_rad = scene.joints[static_cast<std::size_t>(scene.co_contraction->joint)].angle_rad;
  const measure::SweepGrid grid{angles_of(options, joint, scene_angle_rad), levels_of(options)};
  measure::SweepPart result{measure::sweep_origin(scene, grid, MYOTACT_VERSION), shard.part, shard.parts, {}};
  const std::string missing = measure::missing_uncertainty(joint);
  if (!missing.empty()) spdlog::warn("{}", missing);
  watch_for_interruption();
  double wall_s = 0.0;
  {
    Progress progress;
    const auto cells = measure::share_of_cells(grid, shard.part, shard.parts);
    result.rows = measure::sweep_stiffness(
        scene, grid, cells, {[&](int done, int all) { progress.show(done, all); }, [] { return interruption() != 0; }});
    wall_s = progress.seconds();
  }
  if (interruption() != 0) return interruption();
  spdlog::info("{} cells in {:.1f} s, {:.2f} s a cell", result.rows.size(), wall_s,
               wall_s / std::max(1.0, static_cast<double>(result.rows.size())));
  return options.shard.empty() ? answer_sweep(options, result) : answer_part(options, result);
}

}  // namespace

int stiffness(const Options& options) {
  if (!options.merge.empty() && !options.shard.empty()) {
    throw Error(ExitStatus::Usage, "--merge and --shard: give one of them; merging measures nothing");
  }
  if (options.merge.empty() && measure::is_line_model(options.scene)) return line_model_stiffness(options);
  make_writable_folder(options.out);
  return options.merge.empty() ? sweep(options) : answer_sweep(options, measure::merge_parts(options.merge));
}

}  // namespace myotact::app
