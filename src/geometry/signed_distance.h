#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "geometry/pseudo_normals.h"
#include "geometry/triangle_mesh.h"
#include "geometry/triangle_tree.h"

namespace myotact::geometry {

/// The nearest place of a closed surface, with the side on which a point lies.
struct SignedPlace {
  bool found = false;            // false: farther than the radius asked for
  double distance_m = 0.0;       // < 0 inside
  Vec3 outward = Vec3::UnitX();  // unit: where the distance rises
};

/// Signed distance to a closed surface, exact, from its triangles. Where a field of samples (DistanceField) is quicker
/// inside and next to the surface, this one holds at any distance. Built once; const functions may be called from
/// several threads and allocate nothing.
class SignedDistance {
 public:
  explicit SignedDistance(const TriangleMesh& surface);

  /// Nearest place within `radius_m`. A point deeper inside than that is not found either.
  SignedPlace nearest(const Vec3& p, double radius_m) const noexcept;
  /// Distance to the box around the surface, 0 inside: a lower bound of the distance outside. Cheap.
  double box_distance_m(const Vec3& p) const noexcept { return box_.exteriorDistance(p); }
  const Eigen::AlignedBox3d& box() const { return box_; }

 private:
  std::vector<Vec3> positions_m_;
  TriangleTree tree_;
  PseudoNormals normals_;
  Eigen::AlignedBox3d box_;
};

}  // namespace myotact::geometry
