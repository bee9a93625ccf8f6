#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "prepare/volume/label_volume.h"

namespace myotact::prepare {

/// A box of lattice points with numbers of their own, x fastest.
struct PointBox {
  std::array<int, 3> whole{};  // counts of the lattice
  std::array<int, 3> low{};
  std::array<int, 3> counts{};

  std::size_t size() const {
    return static_cast<std::size_t>(counts[0]) * static_cast<std::size_t>(counts[1]) *
           static_cast<std::size_t>(counts[2]);
  }
  /// The lattice's number of a point of the box.
  std::size_t to_lattice(std::size_t point) const {
    const auto [x, y, z] = index_of(counts, point);
    return point_at(whole, x + low[0], y + low[1], z + low[2]);
  }
  /// The box's number of a point of the lattice, which must lie in it.
  std::size_t to_box(std::size_t point) const {
    const auto [x, y, z] = index_of(whole, point);
    return point_at(counts, x - low[0], y - low[1], z - low[2]);
  }
};

inline std::size_t number_of(std::size_t point) {
  return point;
}
template <class Sample>
std::size_t number_of(const Sample& sample) {
  return sample.point;
}

/// The smallest box with `margin` layers around the points (their numbers, or anything with a member `point`), as far
/// as the lattice goes.
template <class Points>
PointBox box_around(const Points& points, const Lattice& lattice, int margin) {
  std::array<int, 3> low = lattice.counts, high{-1, -1, -1};
  for (const auto& sample : points) {
    const std::array<int, 3> i = index_of(lattice.counts, number_of(sample));
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], i[k]);
      high[k] = std::max(high[k], i[k]);
    }
  }
  PointBox box{lattice.counts, {}, {}};
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] = std::max(0, low[k] - margin);
    box.counts[k] = std::max(0, std::min(lattice.counts[k], high[k] + 1 + margin) - box.low[k]);
  }
  return box;
}

}  // namespace myotact::prepare
