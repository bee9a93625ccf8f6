#pragma once

#include <vector>

#include "core/vector.h"
#include "geometry/triangle_mesh.h"

namespace myotact::prepare {

/// How often a surface winds round a point (Jacobson, Kavan and Sorkine-Hornung 2013): 1 inside a closed outward one, 0
/// outside, 2 where it overlaps itself, between them near holes. Far triangles count as one area vector at their middle
/// (Barill and others 2018), which is right to about 0.1. Queries may run in several threads at once.
class WindingNumber {
 public:
  explicit WindingNumber(const geometry::TriangleMesh& surface);

  double operator()(const Vec3& p) const { return surface_.triangles.empty() ? 0.0 : sum(0, p); }

 private:
  /// Some triangles that lie together. Leaf: count > 0 triangles from order_[first]. Inner: children are the next node
  /// and node `first`.
  struct Cluster {
    int first = 0, count = 0;
    Vec3 middle = Vec3::Zero();  // by area
    Vec3 area = Vec3::Zero();    // sum of area vectors
    double radius = 0.0;         // around the middle, of all corners
  };

  int build(int first, int count);
  double sum(int cluster, const Vec3& p) const;

  geometry::TriangleMesh surface_;
  std::vector<int> order_;  // triangles, leaf by leaf
  std::vector<Cluster> clusters_;
};

/// The largest piece of the surface where the winding number is a half, from a lattice: closed, manifold, outward,
/// without crossings, whatever the input. Folds inside vanish, edges are rounded by a part of the spacing.
geometry::TriangleMesh surface_of_winding(const geometry::TriangleMesh& surface, double spacing_m);

}  // namespace myotact::prepare
