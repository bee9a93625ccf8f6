#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "prepare/part/simple_point.h"

namespace myotact::prepare {

/// From a lattice node (x fastest) to those around it, none of which may lie outside the lattice.
struct NodeSteps {
  std::array<std::ptrdiff_t, 27> block{};  // by bit of a Neighbourhood
  std::vector<std::ptrdiff_t> linked;      // those of kLink

  explicit NodeSteps(const std::array<int, 3>& counts) {
    const std::ptrdiff_t row = counts[0], layer = row * counts[1];
    for (int bit = 0; bit < 27; ++bit) {
      const std::ptrdiff_t step = (bit % 3 - 1) + (bit / 3 % 3 - 1) * row + (bit / 9 - 1) * layer;
      block[static_cast<std::size_t>(bit)] = step;
      if ((kLink >> bit & 1U) != 0) linked.push_back(step);
    }
  }
  static std::size_t go(std::size_t node, std::ptrdiff_t step) {
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(node) + step);
  }
};

}  // namespace myotact::prepare
