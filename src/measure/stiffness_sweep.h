#pragma once

#include <functional>
#include <vector>

#include "measure/stiffness_row.h"
#include "scene/scene_file.h"

namespace myotact::measure {

/// Angles times levels; cells are numbered level by level within an angle.
struct SweepGrid {
  std::vector<double> angles_rad;
  std::vector<double> levels;  // of co-contraction, 0 .. 1

  int cells() const { return static_cast<int>(angles_rad.size() * levels.size()); }
  bool operator==(const SweepGrid&) const = default;
};

/// Cells first .. end - 1 of a grid.
struct CellRange {
  int first = 0, end = 0;
};

/// The `part`-th of `parts` consecutive, nearly equal shares of the cells; parts count from 1.
CellRange share_of_cells(const SweepGrid& grid, int part, int parts);

/// How the caller follows a sweep; each may be empty. Called from the sweep's threads, one at a time.
struct SweepWatch {
  std::function<void(int done, int all)> progress;  // pieces of work, of similar length
  std::function<bool()> stopped;                    // true, once and for good: measure no further cell
};

/// Joint stiffness against co-contraction at the angles of the scene's co-contraction joint, one row a cell in the
/// grid's order. Runs on `scene.settings.workers` threads, each with a simulation of its own; a row depends on its
/// angle and level alone, not on the number of threads or the other cells. Rows are fewer when `stopped`. Throws Error
/// BadData when the scene has no co_contraction.
std::vector<StiffnessRow> sweep_stiffness(const scene::Scene& scene, const SweepGrid& grid, CellRange cells,
                                          const SweepWatch& watch = {});

/// The whole grid.
std::vector<StiffnessRow> sweep_stiffness(const scene::Scene& scene, const SweepGrid& grid,
                                          const SweepWatch& watch = {});

}  // namespace myotact::measure
