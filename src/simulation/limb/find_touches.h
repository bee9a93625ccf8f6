#pragma once

#include "simulation/limb/limb.h"

namespace myotact::simulation {

/// Which faces the muscles' nodes are over in the present positions, as far as a step may bring them to touch; also
/// sees the neighbours. Replaces `touches` of all muscles. Nothing without contact. The result does not depend on the
/// workers.
void find_touches(Limb& limb, WorkerPool& workers);

/// The same for muscles of which a node has moved by 0.1 mm since, and their neighbours; else the faces stay, and the
/// neighbours are seen.
void follow_touches(Limb& limb, WorkerPool& workers);

/// Takes over into each touch where the neighbour's nodes are now. No search.
void see_neighbours(Limb& limb);

}  // namespace myotact::simulation
