#include "measure/stiffness_sweep.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>

#include "core/at.h"
#include "core/error.h"
#include "measure/stiffness_cell.h"
#include "simulation/worker_pool.h"

namespace myotact::measure {

namespace {

/// Threads with a simulation each, and what the caller wants to hear of their work.
class Crew {
 public:
  Crew(const scene::Scene& scene, int workers, int all, const SweepWatch& watch)
      : scene_(scene), settings_(scene.settings), pool_(workers), watch_(watch), all_(all) {
    settings_.workers = std::max(1, scene.settings.workers / workers);  // whose number no row depends on
    settings_.shapes = false;
    simulations_.resize(static_cast<std::size_t>(workers));
  }

  /// work(simulation, index) once for each index of 0 .. count-1, in any order, until the caller stops it.
  template <class Work>
  void run(int count, const Work& work) {
    std::atomic<int> next{0};
    pool_.run(pool_.workers(), [&](int worker) {
      for (int index = next++; index < count && !stopped(); index = next++) {
        work(simulation_of(worker), index);
        report();
      }
    });
  }

 private:
  simulation::Simulation& simulation_of(int worker) {
    auto& simulation = simulations_[static_cast<std::size_t>(worker)];
    if (!simulation) simulation = std::make_unique<simulation::Simulation>(scene_.specimen, settings_);
    return *simulation;
  }

  bool stopped() {
    const std::lock_guard lock(mutex_);
    return watch_.stopped && watch_.stopped();
  }

  void report() {
    const std::lock_guard lock(mutex_);
    ++done_;
    if (watch_.progress) watch_.progress(done_, all_);
  }

  const scene::Scene& scene_;
  simulation::SimulationSettings settings_;
  simulation::WorkerPool pool_;
  std::vector<std::unique_ptr<simulation::Simulation>> simulations_;  // one a worker, made when first needed
  const SweepWatch& watch_;
  std::mutex mutex_;  // guards the watch and done_
  int done_ = 0;
  const int all_;
};

}  // namespace

CellRange share_of_cells(const SweepGrid& grid, int part, int parts) {
  const auto end_of = [&](long shares) { return static_cast<int>(shares * grid.cells() / parts); };
  return {end_of(part - 1), end_of(part)};
}

std::vector<StiffnessRow> sweep_stiffness(const scene::Scene& scene, const SweepGrid& grid, CellRange cells,
                                          const SweepWatch& watch) {
  if (!scene.co_contraction) {
    throw bad_data(scene.name, "/co_contraction", "is missing; name the joint and its groups to measure stiffness");
  }
  const int count = cells.end - cells.first;
  if (count <= 0) return {};
  const int levels = static_cast<int>(grid.levels.size());
  const int first_angle = cells.first / levels;
  const int angles = (cells.end - 1) / levels - first_angle + 1;
  const LineLimb lines = line_limb(scene);
  Crew crew(scene, std::clamp(scene.settings.workers, 1, count), angles + count, watch);
  std::vector<scene::TorqueTable> tables(static_cast<std::size_t>(angles));
  const auto angle_rad = [&](int angle) { return grid.angles_rad[at(first_angle + angle)]; };
  crew.run(angles, [&](simulation::Simulation& simulation, int angle) {
    tables[static_cast<std::size_t>(angle)] = torques_at(scene, simulation, angle_rad(angle));
  });
  std::vector<StiffnessRow> rows(static_cast<std::size_t>(count));
  std::vector<char> measured(rows.size(), 0);
  crew.run(count, [&](simulation::Simulation& simulation, int index) {
    const int angle = (cells.first + index) / levels - first_angle;
    const auto level = static_cast<std::size_t>((cells.first + index) % levels);
    const CellPlace place{scene, lines, tables[static_cast<std::size_t>(angle)], angle_rad(angle), grid.levels[level]};
    rows[static_cast<std::size_t>(index)] = measure_cell(place, simulation);
    measured[static_cast<std::size_t>(index)] = 1;
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (measured[i] != 0 && kept++ != i) rows[kept - 1] = std::move(rows[i]);
  }
  rows.resize(kept);
  return rows;
}

std::vector<StiffnessRow> sweep_stiffness(const scene::Scene& scene, const SweepGrid& grid, const SweepWatch& watch) {
  return sweep_stiffness(scene, grid, {0, grid.cells()}, watch);
}

}  // namespace myotact::measure
