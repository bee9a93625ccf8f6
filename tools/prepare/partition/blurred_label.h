#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "core/vector.h"
#include "prepare/partition/part_volume.h"

namespace myotact::prepare {

struct ChosenSegment;

/// Width of the Gaussian that labels are blurred by, in steps of the finer lattice: less leaves stairs, more rounds
/// edges off by more than half a step.
constexpr double kBlur = 0.9;

/// The box of a segment's voxels in its volume, first and last index along each direction.
struct IndexBox {
  std::array<int, 3> low{std::numeric_limits<int>::max(), std::numeric_limits<int>::max(),
                         std::numeric_limits<int>::max()};
  std::array<int, 3> high{-1, -1, -1};
  std::size_t voxels = 0;

  void extend(const IndexBox& other) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], other.low[k]);
      high[k] = std::max(high[k], other.high[k]);
    }
    voxels += other.voxels;
  }
  Vec3 low_corner() const {
    return {static_cast<double>(low[0]), static_cast<double>(low[1]), static_cast<double>(low[2])};
  }
  Vec3 extent() const {
    return {static_cast<double>(high[0] - low[0]), static_cast<double>(high[1] - low[1]),
            static_cast<double>(high[2] - low[2])};
  }
};

/// One box a segment.
std::vector<IndexBox> boxes_of(const LabelVolume& volume, const std::vector<ChosenSegment>& segments);

/// How much of its neighbourhood belongs to a segment, 0 .. 1, at the points of a box of a lattice.
struct BlurredLabel {
  std::array<int, 3> low{}, counts{};
  std::vector<float> values;  // x fastest

  /// Calls visit(point of the lattice, value).
  template <class Visit>
  void for_each(const Lattice& lattice, Visit&& visit) const {
    std::size_t i = 0;
    for (int z = 0; z < counts[2]; ++z) {
      for (int y = 0; y < counts[1]; ++y) {
        std::size_t point = point_at(lattice.counts, low[0], low[1] + y, low[2] + z);
        for (int x = 0; x < counts[0]; ++x) visit(point++, values[i++]);
      }
    }
  }
};

/// The segment's voxels blurred, along each direction by kBlur steps of the lattice, or by as much of the voxels'
/// spacing where that is wider. The lattice has equal steps along the volume's directions.
BlurredLabel blur_label(const LabelVolume& volume, int layer, int label, const IndexBox& box, const Lattice& lattice);

}  // namespace myotact::prepare
