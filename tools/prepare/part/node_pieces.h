#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace myotact::prepare {

/// The pieces of the marked nodes of a block (`counts` along x, y and z, x fastest), as edges of the tetrahedra join
/// them (simple_point.h), the largest first. No node of the outermost layer is marked.
std::vector<std::vector<std::size_t>> pieces_of_nodes(const std::array<int, 3>& counts,
                                                      const std::vector<bool>& marked);

}  // namespace myotact::prepare
