#pragma once

#include <vector>

#include "prepare/measure/share_out.h"
#include "prepare/partition/part_volume.h"

namespace myotact::prepare {

/// What making a part whole did to it.
struct Wholeness {
  std::size_t added = 0;    // lattice points that close its holes and join its pieces
  std::size_t dropped = 0;  // of loose specks, which went to neighbours
};

/// Muscles that sharing out pierced or cut become whole again, small ones first: thin films through what pierces them,
/// strands between their pieces, never through bone (hollow_out.h). What then still hangs loose goes to the neighbour
/// that claims it, or to none. Bones, and muscles whose surfaces have handles of their own (`genus`, one a claim), are
/// left as they are, but for specks. One entry a claim.
std::vector<Wholeness> keep_whole(PartVolume& volume, const std::vector<Claim>& claims, const std::vector<int>& genus);

}  // namespace myotact::prepare
