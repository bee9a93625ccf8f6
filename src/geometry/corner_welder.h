#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/triangle_mesh.h"

namespace myotact::geometry {

/// Joins corners with exactly the same coordinates, in order of appearance; 0 and -0 are the same. A hash table, since
/// scans hold many millions of corners: an ordered map takes minutes and several gigabytes for them.
class CornerWelder {
 public:
  /// Room for a surface of so many triangles, for speed only.
  explicit CornerWelder(std::size_t expected_triangles = 0);

  void add(const std::array<Vec3, 3>& corners);
  int vertex(const Vec3& position_m);
  std::size_t vertex_count() const { return mesh_.positions_m.size(); }
  TriangleMesh take() { return std::move(mesh_); }

 private:
  struct Slot {
    std::uint32_t tag = 0;  // high bits of the hash: spares most looks at the position
    int vertex = -1;
  };

  std::size_t find(const Vec3& position_m, std::uint64_t hash) const;
  void grow();

  std::vector<Slot> slots_;  // open addressing; a power of two, at most half of them in use
  TriangleMesh mesh_;
};

}  // namespace myotact::geometry
