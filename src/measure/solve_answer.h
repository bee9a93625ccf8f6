#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/mesh_files.h"
#include "measure/solve_case.h"

// The one place that calls the finite-element solver for a case.

namespace myotact::measure {

struct SolveProgress {
  double share = 0.0;           // of the load that is being applied, or of the time
  double residual_share = 0.0;  // out-of-balance force over the elements' forces
  int iterations = 0;           // Newton steps so far
};

struct SolveAnswer {
  std::string name;
  bool converged = false;
  int steps = 0;       // of the load or of time, that succeeded
  int iterations = 0;  // Newton steps
  double wall_s = 0.0;
  double reached = 0.0;  // share of the load or of the time
  std::size_t most_crushed_tet = 0;
  double least_volume_ratio = 1.0;  // of that tet, the mean over it; not above 0: inside out, and not converged
  std::vector<std::pair<CaseOutput, std::vector<double>>> outputs;
  geometry::TetFile deformed;  // the mesh in the last converged state
  geometry::TetResults results;
};

/// Solves a case. `progress` is called after every Newton step of a static case and after every step of a motion; what
/// it throws ends the solve. Throws Error BadData for what only the solver can see, such as curved mid-sides.
SolveAnswer solve_case(const SolveCase& input, const std::function<void(const SolveProgress&)>& progress);

/// {case, converged, steps, iterations, wall_s, outputs{name: value}, units{name: unit}} and a newline.
std::string answer_json(const SolveAnswer& answer);

}  // namespace myotact::measure
