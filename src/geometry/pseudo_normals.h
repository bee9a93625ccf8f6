#pragma once

#include <map>
#include <span>
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

/// The triangles that each of so many vertices is a corner of.
std::vector<std::vector<int>> triangles_around(const TriangleTree& surface, std::size_t vertices);

/// PseudoNormals::at() of a surface whose vertices have moved to `positions_m`, from the triangles that meet at the
/// place. `around`: its triangles_around(). Several threads may call it.
Vec3 pseudo_normal(const TriangleTree& surface, std::span<const std::vector<int>> around,
                   std::span<const Vec3> positions_m, const SurfacePlace& place);

}  // namespace myotact::geometry
