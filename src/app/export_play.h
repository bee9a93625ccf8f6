#pragma once

#include <functional>

#include "app/options.h"
#include "scene/scene_file.h"
#include "simulation/simulation.h"

namespace myotact::app {

/// Looks at the scene as it is then.
using SceneTaker = std::function<void(const simulation::Simulation& simulation)>;

/// Steps between two frames of what moves: --every, or so many that there are about 20 frames a second.
int steps_between_frames(const Options& options, const scene::Scene& scene);

/// Brings the limb to balance and plays the scene's script for --seconds. `each` (may be empty) is called at the start
/// and after every so many steps, `last` (may be empty) at the end. Nothing is called after Ctrl-C. Throws Error.
void play(const Options& options, const scene::Scene& scene, const SceneTaker& each, const SceneTaker& last);

/// Writes FILE.pvd and, into the folder FILE beside it, the tets (.vtu) and the surfaces (.vtp) of every frame of the
/// script. Throws Error InputOutput.
void write_series(const Options& options, const scene::Scene& scene);

}  // namespace myotact::app
