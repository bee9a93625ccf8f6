#pragma once

#include "prepare/partition/interfaces.h"

namespace myotact::prepare {

/// Evens out lines where three parts meet, and the surfaces beside them. A lattice point knows how far its nearest
/// border is, not which of two: edges to the farther one are cut at a wrong place, and thin parts beside others get
/// steps of half the lattice's. Places wander towards the middle of their neighbours and back (Taubin 1995), which
/// smooths what is a step or two long and shrinks nothing; on lines along the line. What lies apart from other parts
/// stays as it is; neighbours go on sharing their triangles. The same vertices and faces as before.
Interfaces smooth_interfaces(const Interfaces& interfaces);

}  // namespace myotact::prepare
