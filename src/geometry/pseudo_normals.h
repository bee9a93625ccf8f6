#pragma once

#include <map>
#include <utility>
#include <vector>

#include "core/vector.h"
#include "geometry/triangle_mesh.h"
#include "geometry/triangle_tree.h"

namespace myotact::geometry {

/// Outward directions by which the sign of a distance follows from the nearest place alone: a face's normal, the sum of
/// two faces' on an edge, weighted by angle at a corner (Baerentzen and Aanaes, IEEE TVCG 11:243, 2005). Of a closed
/// surface with its triangles outward. Const functions may be called from several threads.
class PseudoNormals {
 public:
  explicit PseudoNormals(const TriangleMesh& surface);

  /// Not of unit length. `place` on the surface, with its triangle.
  Vec3 at(const SurfacePlace& place) const;

 private:
  std::vector<std::array<int, 3>> triangles_;
  std::vector<Vec3> faces_, corners_;
  std::map<std::pair<int, int>, Vec3> edges_;
};

}  // namespace myotact::geometry
