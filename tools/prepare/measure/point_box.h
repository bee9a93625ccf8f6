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
    const std::array<int, 3> i = split(point, counts);
    return join({i[0] + low[0], i[1] + low[1], i[2] + low[2]}, whole);
  }
  /// The box's number of a point of the lattice, which must lie in it.
  std::size_t to_box(std::size_t point) const {
    const std::array<int, 3> i = split(point, whole);
    return join({i[0] - low[0], i[1] - low[1], i[2] - low[2]}, counts);
  }

  static std::array<int, 3> split(std::size_t point, const std::array<int, 3>& counts) {
    const auto nx = static_cast<std::size_t>(counts[0]), ny = static_cast<std::size_t>(counts[1]);
    return {static_cast<int>(point % nx), static_cast<int>(point / nx % ny), static_cast<int>(point / nx / ny)};
  }
  static std::size_t join(const std::array<int, 3>& i, const std::array<int, 3>& counts) {
    return static_cast<std::size_t>(i[0]) +
           static_cast<std::size_t>(counts[0]) *
               (static_cast<std::size_t>(i[1]) + static_cast<std::size_t>(counts[1]) * static_cast<std::size_t>(i[2]));
  }
};

/// The smallest box with `margin` layers around the points (anything with a member `point`), as far as the lattice
/// goes.
template <class Points>
PointBox box_around(const Points& points, const Lattice& lattice, int margin) {
  std::array<int, 3> low = lattice.counts, high{-1, -1, -1};
  for (const auto& sample : points) {
    const std::array<int, 3> i = PointBox::split(sample.point, lattice.counts);
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
