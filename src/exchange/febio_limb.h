#pragma once

#include <string>
#include <vector>

#include "anatomy/specimen.h"
#include "exchange/febio_write.h"
#include "scene/scene_file.h"
#include "simulation/simulation.h"

namespace myotact::exchange {

/// Muscles as they hang on their bones now, as a static case from the file pose: what is clamped is moved to where its
/// bone is, the belly's ends on tendons to where they are now, fibres are active as they are now. `notes` says in what
/// it differs from the program's own muscles.
struct FebioLimb {
  measure::SolveCase solve_case;
  std::vector<double> activations;  // one a material
  std::vector<std::string> notes;
};

/// `muscles`: of the scene's specimen, at least one. `simulation`: of that scene, after a step or settle.
FebioLimb febio_limb(const scene::Scene& scene, const simulation::Simulation& simulation,
                     const std::vector<int>& muscles);

}  // namespace myotact::exchange
