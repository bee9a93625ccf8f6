#pragma once

#include <cstddef>
#include <vector>

#include "prepare/partition/interfaces.h"

// Borders cut into slabs that can be worked on side by side, and put together again.

namespace myotact::prepare {

/// One slab's faces with vertices of their own.
struct Slab {
  Interfaces interfaces;
  std::vector<int> whole;       // each vertex's number in the whole
  std::vector<bool> is_shared;  // with other slabs
};

/// As many faces a slab, along the longest direction of all; one slab where there are few. Depends on the interfaces
/// only.
std::vector<Slab> split_into_slabs(const Interfaces& interfaces);

/// Puts slabs together again at the vertices that they share, which must be where they were. `vertices`: of the whole.
Interfaces join_slabs(const std::vector<Slab>& slabs, std::size_t vertices);

}  // namespace myotact::prepare
