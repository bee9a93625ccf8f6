#pragma once

#include <span>
#include <vector>

#include "simulation/contact/contact_law.h"
#include "simulation/muscle/touch_surface.h"

namespace myotact::simulation {

// Fascia holds surfaces that lie side by side at the file pose. Which node is held at which neighbour stays for good,
// and so does the place on it until the two have slid far: nothing flips between faces while they come to rest.

/// Finds what fascia holds: each free surface node at the neighbour nearest to it, where that is within reach and faces
/// it. At the file pose; fills `bonds` and `held_by`. One surface a muscle; null for those without.
void lay_bonds(const std::vector<MuscleTissue*>& tissues, const Fascia& fascia, std::vector<TouchSurface>& surfaces);

/// The face that a bond holds its node p at. Where p has slid far from it, the bond's place is first carried to the one
/// nearest to p, from triangle to triangle. Triangle -1 in a fold. `positions_m`: of the other's nodes, those that it
/// followed last.
TouchSurface::Found slide_bond(const Vec3& p, const TouchSurface& other, std::span<const Vec3> positions_m,
                               FasciaBond& bond);

}  // namespace myotact::simulation
