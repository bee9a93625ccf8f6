#pragma once

#include <array>
#include <vector>

#include <Eigen/Geometry>

#include "core/vector.h"
#include "geometry/triangle_mesh.h"
#include "geometry/triangle_tree.h"

namespace myotact::prepare {

/// Signed distance to a closed, manifold, outward surface without crossings [m]: negative inside. The sign comes from
/// the angle-weighted normal of the nearest face, edge or vertex (Baerentzen and Aanaes 2005), which is exact for such
/// surfaces. Queries may run in several threads at once.
class SignedDistance {
 public:
  explicit SignedDistance(const geometry::TriangleMesh& surface);

  double operator()(const Vec3& p) const { return nearest(p).first; }

  /// The same with the point of the surface that it is measured to.
  std::pair<double, Vec3> nearest(const Vec3& p) const;

  const Eigen::AlignedBox3d& box() const { return box_; }
  double volume_m3() const { return volume_m3_; }
  const geometry::TriangleMesh& surface() const { return surface_; }

 private:
  /// Outward normal of the feature (face, edge or vertex) of the triangle that the barycentric point lies on; its
  /// length means nothing.
  Vec3 normal_at(int triangle, const std::array<double, 3>& barycentric) const;

  geometry::TriangleMesh surface_;
  geometry::TriangleTree tree_;
  Eigen::AlignedBox3d box_;
  double volume_m3_ = 0.0;
  std::vector<Vec3> face_normals_;
  std::vector<Vec3> vertex_normals_;  // sums weighted by the angles of their faces
  std::vector<int> opposite_sides_;   // of the triangles' sides (edge_table.h)
};

}  // namespace myotact::prepare
