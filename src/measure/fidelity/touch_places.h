#pragma once

#include <cstdint>
#include <vector>

#include "anatomy/specimen.h"
#include "core/vector.h"
#include "simulation/simulation.h"

namespace myotact::measure {

/// A place on a muscle's skin to which a hand can come from outside. In the world, unit directions.
struct TouchPlace {
  int muscle = -1;
  Vec3 position_m = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  // out of the muscle
  Vec3 along = Vec3::UnitX();   // across the normal: as the muscle's line runs
};

/// Up to `count` a muscle, in the specimen's order, at random by area on the skins as the simulation stands; the same
/// for the same seed. A place counts when a ball of `tool_radius_m` comes to it along its normal from 40 mm outside
/// and meets nothing on the way. Muscles that lie under others get fewer, or none.
std::vector<TouchPlace> touch_places(const anatomy::Specimen& specimen, const simulation::Simulation& simulation,
                                     double tool_radius_m, int count, std::uint64_t seed);

}  // namespace myotact::measure
