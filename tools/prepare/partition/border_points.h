#pragma once

#include <cstddef>
#include <vector>

#include "prepare/partition/part_volume.h"

namespace myotact::prepare {

/// Whether the two outer layers of the lattice belong to no part, so that no surface reaches its rim.
bool has_free_rim(const Lattice& lattice, const Labels& labels);

/// The points that an edge of the lattice's tetrahedra joins to one with another label, by rising number. The rim must
/// be free.
std::vector<std::size_t> border_points(const Lattice& lattice, const Labels& labels);

}  // namespace myotact::prepare
