#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/LU>

#include "core/vector.h"
#include "prepare/volume/label_volume.h"

namespace myotact::prepare {

/// Margins are counted in this part of a step: surfaces are good to a thirtieth of a step, and the margins of a limb at
/// one millimetre take less than twice the room of its labels.
constexpr double kMarginsPerStep = 16.0;
/// Nothing that is this many steps from a border has an edge across it.
constexpr double kLargestMargin = 2.0;

/// Parts that share space without gap or overlap: each lattice point belongs to one part or to none, and knows how far
/// it is to the border with its neighbours. Steps are equal and at right angles.
struct PartVolume {
  Lattice lattice;
  std::vector<std::string> keys;      // of labels 1, 2, ...
  Labels labels;                      // 0: none
  std::vector<std::uint8_t> margins;  // in kMarginsPerStep-ths of a step; any number where all neighbours are alike
};

inline double step_m(const Lattice& lattice) {
  return lattice.steps_m.col(0).norm();
}

/// Place of a point of the lattice, not necessarily a whole one.
inline Vec3 place_m(const Lattice& lattice, const Vec3& index) {
  return lattice.origin_m + lattice.steps_m * index;
}

inline Vec3 place_m(const Lattice& lattice, std::size_t point) {
  const auto [x, y, z] = index_of(lattice.counts, point);
  return place_m(lattice, Vec3(x, y, z));
}

/// The lattice's point nearest to a place [m], on its rim where that lies outside.
inline std::size_t nearest_point(const Lattice& lattice, const Vec3& p_m) {
  const Vec3 index = lattice.steps_m.inverse() * (p_m - lattice.origin_m);
  std::array<int, 3> i{};
  for (std::size_t k = 0; k < 3; ++k) {
    i[k] = std::clamp(static_cast<int>(std::lround(index[static_cast<Eigen::Index>(k)])), 0, lattice.counts[k] - 1);
  }
  return point_at(lattice.counts, i[0], i[1], i[2]);
}

}  // namespace myotact::prepare
