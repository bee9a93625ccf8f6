#include "measure/fidelity/network_goals.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "measure/fidelity/network_run.h"
#include "scene/scene_file.h"

namespace myotact::measure {

namespace {

struct Condition {
  const char* name;
  NetworkCase link;
  double most_error;  // of the local force's size; 0: no goal
  double least_size;  // of the mean force over the local one; 0: no goal
};

// A stall of 0.1 s every 10 s, each way: 1 % of the time nothing arrives.
constexpr Condition kConditions[] = {
    {"5 ms", {0.005, 0.0, 0.0}, 0.05, 0.9},         {"20 ms", {0.020, 0.0, 0.0}, 0.15, 0.9},
    {"50 ms", {0.050, 0.0, 0.0}, 0.0, 0.9},         {"100 ms", {0.100, 0.0, 0.0}, 0.0, 0.0},
    {"200 ms", {0.200, 0.0, 0.0}, 0.0, 0.5},        {"20 ms, jitter 10 ms", {0.020, 0.010, 0.0}, 0.0, 0.0},
    {"20 ms, stalls", {0.020, 0.0, 0.1}, 0.0, 0.0},
};

constexpr double kMostEnergy_J = 1e-3;
constexpr double kPulse_N = 0.030;

/// Of the difference over that of the local force, root mean square.
double error_of(const NetworkRun& run, const NetworkRun& local) {
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < run.force_N.size(); ++i) {
    difference += (run.force_N[i] - local.force_N[i]).squaredNorm();
    size += local.force_N[i].squaredNorm();
  }
  return std::sqrt(difference / size);
}

double mean_size_N(const NetworkRun& run) {
  double sum = 0.0;
  for (const Vec3& force_N : run.force_N) sum += force_N.norm();
  return sum / static_cast<double>(run.force_N.size());
}

void add_figures(const std::string& scene, const Condition& condition, const NetworkRun& run, const NetworkRun& local,
                 GoalFigures& result) {
  const std::string where = fmt::format("{}, {}: ", scene, condition.name);
  const double error = error_of(run, local), size = mean_size_N(run) / mean_size_N(local);
  if (condition.most_error > 0.0)
    result.figures.push_back({where + "error of the force", 100.0 * error, "%", 100.0 * condition.most_error});
  if (condition.least_size > 0.0)
    result.figures.push_back(
        {where + "mean force over the local one", 100.0 * size, "%", 100.0 * condition.least_size, true});
  // Without a link a spring that is sampled at 1 kHz gives some, too, which is not the network's.
  const double energy_J = run.most_net_J - std::min(run.most_net_J, local.most_net_J);
  result.figures.push_back(
      {where + "net energy to the hand beyond the local run's", 1e3 * energy_J, "mJ", 1e3 * kMostEnergy_J});
  if (condition.link.stalls_per_s > 0.0)
    result.figures.push_back({where + "largest step of the force after a break", 1e3 * run.largest_rise_after_break_N,
                              "mN", 1e3 * kPulse_N});
  result.note += fmt::format(
      "{}error {:.1f} %, mean force {:.1f} % of {:.3f} N, jitter {:.0f} mN, oldest model {:.0f} ms, "
      "gate shut {:.1f} % of the time, buzzes {}; ",
      where, 100.0 * error, 100.0 * size, mean_size_N(local), 1e3 * run.jitter_N, 1e3 * run.largest_age_s,
      100.0 * static_cast<double>(run.faded_ticks) / static_cast<double>(run.force_N.size()), run.buzzes);
}

/// `all`: of the conditions; otherwise those with a goal of the force, without jitter and stalls.
void measure_scene(const std::string& name, double seconds, bool all, GoalFigures& result) {
  scene::Scene scene = scene::load_scene(name);
  scene.settings.workers = 1;
  NetworkRunRequest request;
  request.seconds = seconds;
  const NetworkRun local = run_over_network(scene, request);
  request.path_m = &local.hand_m;
  for (const Condition& condition : kConditions) {
    if (!all && condition.most_error == 0.0 && condition.least_size == 0.0) continue;
    request.link = condition.link;
    add_figures(name, condition, run_over_network(scene, request), local, result);
  }
}

}  // namespace

GoalFigures measure_network(Effort effort) {
  const bool full = effort == Effort::Full;
  GoalFigures result;
  measure_scene("elbow", full ? 60.0 : 6.0, full, result);
  for (const char* name : {"spring", "particle"}) measure_scene(name, full ? 1800.0 : 30.0, true, result);
  return result;
}

}  // namespace myotact::measure
