#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/at.h"
#include "geometry/triangle_mesh.h"

namespace myotact::prepare {

/// One side of a triangle: from its corner side % 3 to the next. Triangle = side / 3.
inline int next_corner(int side) {
  return side % 3 == 2 ? side - 2 : side + 1;
}

/// The vertex that a side starts from, and the one it goes to.
inline int tail_of(const geometry::TriangleMesh& mesh, int side) {
  return mesh.triangles[at(side / 3)][at(side % 3)];
}
inline int head_of(const geometry::TriangleMesh& mesh, int side) {
  return tail_of(mesh, next_corner(side));
}

struct EdgeUse {
  int high;  // the larger vertex of the edge
  int side;
};

/// The edges of any set of triangles with the sides that run along them: two arrays, sorted within buckets by the lower
/// vertex, because a map would take minutes and gigabytes for five million triangles. No triangle repeats a vertex.
class EdgeTable {
 public:
  explicit EdgeTable(const geometry::TriangleMesh& mesh);

  /// Calls visit(low, high, uses) for each edge, by rising low, then high; uses by rising side.
  template <class Visit>
  void for_each_edge(Visit&& visit) const {
    for (int low = 0; low + 1 < static_cast<int>(first_.size()); ++low) {
      for (std::size_t begin = first_[at(low)]; begin < first_[at(low + 1)];) {
        std::size_t end = begin + 1;
        while (end < first_[at(low + 1)] && uses_[end].high == uses_[begin].high) ++end;
        visit(low, uses_[begin].high, std::span<const EdgeUse>(&uses_[begin], end - begin));
        begin = end;
      }
    }
  }

 private:
  std::vector<EdgeUse> uses_;
  std::vector<std::size_t> first_;  // of each lower vertex, and the end
};

inline constexpr int kOpen = -1;     // no other triangle at this side
inline constexpr int kCrowded = -2;  // more than one

/// For each side the one of the neighbour along the same edge, whichever way it runs; or kOpen, kCrowded.
std::vector<int> opposite_sides(const geometry::TriangleMesh& mesh);

/// Whether every side has exactly one neighbour, and that runs the other way.
bool is_closed(const geometry::TriangleMesh& mesh);

/// How many edges have one triangle, and how many more than two.
struct EdgeCounts {
  int open = 0;
  int crowded = 0;
  double open_length = 0.0;
};
EdgeCounts count_edges(const geometry::TriangleMesh& mesh);

/// Joins numbers into groups; the group's name is its lowest number.
class Groups {
 public:
  explicit Groups(std::size_t count);
  int group_of(int i);
  void join(int a, int b);

 private:
  std::vector<int> parent_;
};

}  // namespace myotact::prepare
