#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "prepare/partition/part_volume.h"

namespace myotact::prepare {

/// The cheapest way over the lattice from a point of a bone's border to a part, never through bone: free points cost
/// their distance, those beside bone more, so that a tendon is not buried in it, those of other muscles much more. `to`
/// is the part's point nearest to `from`; `bone` has one entry a label. Places from bone to part [m], evened out;
/// nothing when no way is to be found around the two.
std::optional<std::vector<Vec3>> find_tendon_way(const PartVolume& volume, const std::vector<bool>& bone,
                                                 std::size_t from, std::size_t to, std::uint16_t part);

}  // namespace myotact::prepare
