#include "prepare/part/simple_point.h"

#include <array>
#include <bit>
#include <cstddef>

namespace myotact::prepare {

namespace {

constexpr int kMiddle = 13;

/// Offset of a bit in one direction: -1, 0 or 1.
constexpr int offset(int bit, int direction) {
  const int scale = direction == 0 ? 1 : direction == 1 ? 3 : 9;
  return bit / scale % 3 - 1;
}

/// Whether an edge of the tetrahedra runs between two nodes of the block.
constexpr bool joined(int a, int b) {
  int up = 0, down = 0;
  for (int direction = 0; direction < 3; ++direction) {
    const int step = offset(b, direction) - offset(a, direction);
    if (step < -1 || step > 1) return false;
    up += step > 0 ? 1 : 0;
    down += step < 0 ? 1 : 0;
  }
  return (up > 0) != (down > 0);
}

constexpr std::array<Neighbourhood, 27> neighbours_in_block() {
  std::array<Neighbourhood, 27> table{};
  for (int a = 0; a < 27; ++a) {
    for (int b = 0; b < 27; ++b) {
      if (joined(a, b)) table[static_cast<std::size_t>(a)] |= Neighbourhood{1} << b;
    }
  }
  return table;
}

constexpr std::array<Neighbourhood, 27> kNeighbours = neighbours_in_block();

/// Whether there are nodes, and they hang together.
bool in_one_piece(Neighbourhood nodes) {
  Neighbourhood reached = 0, fresh = nodes & (~nodes + 1);
  while (fresh != 0) {
    reached |= fresh;
    Neighbourhood around = 0;
    for (Neighbourhood rest = fresh; rest != 0; rest &= rest - 1) {
      around |= kNeighbours[static_cast<std::size_t>(std::countr_zero(rest))];
    }
    fresh = around & nodes & ~reached;
  }
  return nodes != 0 && reached == nodes;
}

}  // namespace

const Neighbourhood kLink = kNeighbours[kMiddle];

bool is_simple(Neighbourhood body) {
  return in_one_piece(body & kLink) && in_one_piece(~body & kLink);
}

}  // namespace myotact::prepare
