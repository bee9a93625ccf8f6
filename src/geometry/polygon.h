#pragma once

#include <span>
#include <vector>

#include "geometry/triangle_mesh.h"

namespace myotact::geometry {

/// Polygons with more corners are refused by the readers: the work grows with their square.
inline constexpr std::size_t kMostCorners = 10'000;

/// Cuts polygons into triangles that do not overlap, convex or not, by taking off one ear after the other in the
/// polygon's own plane. A convex polygon becomes the fan of its first corner.
class PolygonCutter {
 public:
  /// Appends n - 2 triangles over the n >= 3 corners, which index `mesh`, turning as the polygon does. False when some
  /// of them must overlap, because the polygon crosses itself. What has no area gives triangles without one.
  bool cut(std::span<const int> corners, TriangleMesh& mesh);

 private:
  struct Corner {
    int vertex = 0;
    double x = 0.0, y = 0.0;  // in the plane
    int orientation = 0;      // 1 to the left, 0 straight on, -1 to the right
    bool ear = false;
  };

  static int side(const Corner& from, const Corner& to, const Corner& point);
  void place(std::span<const int> corners, const TriangleMesh& mesh);
  void classify(std::size_t index);
  void classify_all();
  /// The first corner from the second on, for the fan, that fits; as many as there are corners when none does.
  template <class Fits>
  std::size_t first(Fits&& fits) const;
  std::size_t choose();
  void take_off(std::size_t index, TriangleMesh& mesh);
  std::size_t before(std::size_t index) const { return (index == 0 ? corners_.size() : index) - 1; }
  std::size_t after(std::size_t index) const { return index + 1 == corners_.size() ? 0 : index + 1; }

  std::vector<Corner> corners_;  // not taken off yet
  int fresh_starts_ = 0;         // how often all corners may still be classified anew
};

}  // namespace myotact::geometry
