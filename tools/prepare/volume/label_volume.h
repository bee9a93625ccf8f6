#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/vector.h"

// A segmented volume: points of a lattice, each of which belongs to one part of the limb or to none.

namespace myotact::prepare {

/// Points at equal steps along three directions, which may be oblique to the frame and differ in length; x fastest.
struct Lattice {
  std::array<int, 3> counts{};
  Vec3 origin_m = Vec3::Zero();     // of point (0, 0, 0), specimen frame
  Mat3 steps_m = Mat3::Identity();  // columns: from a point to the next along x, y and z; at right angles

  std::size_t size() const {
    return static_cast<std::size_t>(counts[0]) * static_cast<std::size_t>(counts[1]) *
           static_cast<std::size_t>(counts[2]);
  }
};

/// Number of a point of a block of `counts` points, x fastest, and back.
inline std::size_t point_at(const std::array<int, 3>& counts, int x, int y, int z) {
  const auto nx = static_cast<std::size_t>(counts[0]), ny = static_cast<std::size_t>(counts[1]);
  return static_cast<std::size_t>(x) + nx * (static_cast<std::size_t>(y) + ny * static_cast<std::size_t>(z));
}
inline std::array<int, 3> index_of(const std::array<int, 3>& counts, std::size_t point) {
  const auto nx = static_cast<std::size_t>(counts[0]), ny = static_cast<std::size_t>(counts[1]);
  return {static_cast<int>(point % nx), static_cast<int>(point / nx % ny), static_cast<int>(point / nx / ny)};
}

/// Of the lattice's outermost layer, whose points have no neighbours on one side.
inline bool on_rim(const std::array<int, 3>& counts, std::size_t point) {
  const std::array<int, 3> i = index_of(counts, point);
  for (std::size_t k = 0; k < 3; ++k) {
    if (i[k] == 0 || i[k] == counts[k] - 1) return true;
  }
  return false;
}

/// A label with what its file says of it.
struct Segment {
  std::string name;  // as in the file; "label 7" where it has none
  int label = 0;     // in its layer; 0 is no part
  int layer = 0;
  std::vector<std::string> hints;  // other names of it in the file (Slicer's terminology)
};

using Labels = std::vector<std::uint16_t>;  // one a lattice point, x fastest; 0: no part

/// What a file of labels holds. Parts of different layers may overlap.
struct LabelVolume {
  Lattice lattice;
  std::vector<Labels> layers;      // at least one
  std::vector<Segment> segments;   // all labels that occur, by layer and label
  std::vector<std::string> notes;  // what a person should know: units, frame, sampling
};

}  // namespace myotact::prepare
