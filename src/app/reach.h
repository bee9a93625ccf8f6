#pragma once

#include <vector>

#include "anatomy/specimen.h"
#include "core/vector.h"
#include "simulation/simulation.h"

namespace myotact::app {

/// Where a hand gets at a muscle: a place along its line and the direction out of the limb from which it comes.
struct Reach {
  double at = 0.5;  // along the line, 0 origin .. 1 insertion
  Vec3 from = Vec3::UnitY();
  double clear_m = 0.0;  // how far the muscle stands out over its neighbours there, seen along `from`
};

/// The places at which nothing lies over the muscle, the clearest first; looked for in steps of a tenth of the line and
/// of 30 degrees about the vertical. Skins and bones as they are now.
std::vector<Reach> reaches_of(int muscle, const anatomy::Specimen& specimen, const simulation::Simulation& simulation);

}  // namespace myotact::app
