#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <Eigen/Geometry>

#include "core/vector.h"
#include "prepare/remesh/triangle_crossing.h"

namespace myotact::prepare {

/// Triangles by the cubes of space that their boxes touch, for meshes that change.
class FaceGrid {
 public:
  explicit FaceGrid(double cell_m) : cell_m_(cell_m) {}

  /// The face must not be in the grid.
  void insert(int face, const Corners& corners);
  void remove(int face);

  /// Calls visit(face, corners) once for every face whose box meets the box; stops when it returns true. Returns
  /// whether it did.
  template <class Visit>
  bool any(const Eigen::AlignedBox3d& box, Visit&& visit) const {
    ++query_;
    const auto [low, high] = cells_of(box);
    for (int x = low[0]; x <= high[0]; ++x) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int z = low[2]; z <= high[2]; ++z) {
          const auto cell = cells_.find(key_of({x, y, z}));
          if (cell == cells_.end()) continue;
          for (const int face : cell->second) {
            const Entry& entry = entries_[static_cast<std::size_t>(face)];
            if (entry.seen == query_) continue;
            entry.seen = query_;
            if (entry.box.intersects(box) && visit(face, entry.corners)) return true;
          }
        }
      }
    }
    return false;
  }

 private:
  using Cell = std::array<int, 3>;
  struct Entry {
    Corners corners;
    Eigen::AlignedBox3d box;
    mutable std::uint64_t seen = 0;  // the query that last came by
  };

  static std::uint64_t key_of(const Cell& cell);
  std::pair<Cell, Cell> cells_of(const Eigen::AlignedBox3d& box) const;

  double cell_m_;
  std::vector<Entry> entries_;  // by face
  std::unordered_map<std::uint64_t, std::vector<int>> cells_;
  mutable std::uint64_t query_ = 0;
};

}  // namespace myotact::prepare
