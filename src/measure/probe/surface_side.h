#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/triangle_mesh.h"
#include "geometry/triangle_tree.h"

namespace myotact::measure {

/// What is odd about a surface. None of it stops a proxy.
struct SurfaceDefects {
  int triangles_without_area = 0;
  int border_edges = 0;        // with one triangle only: the surface is open
  int non_manifold_edges = 0;  // with three and more, or two that face opposite ways
};
SurfaceDefects find_defects(const geometry::TriangleMesh& mesh);

/// Computes whether a point lies behind a moving surface, independently of the proxy: by the angle-weighted
/// pseudo-normal of the nearest point (Baerentzen and Aanaes 2005), which on a closed surface the winding number must
/// confirm.
class SurfaceSide {
 public:
  /// Keeps a reference to the mesh, for its triangles.
  explicit SurfaceSide(const geometry::TriangleMesh& mesh);

  /// The frames between which the surface will be.
  void fit(std::span<const Vec3> previous_m, std::span<const Vec3> current_m) { tree_.refit(previous_m, current_m); }
  /// `positions_m` lies between the frames last fitted. Beyond the border of an open surface nothing is inside.
  bool inside(const Vec3& p, const std::vector<Vec3>& positions_m) const;
  bool closed() const { return closed_; }

 private:
  Vec3 outward(const geometry::SurfacePlace& place, const std::vector<Vec3>& positions_m) const;

  const geometry::TriangleMesh& mesh_;
  geometry::TriangleTree tree_;
  bool closed_ = true;
  std::vector<int> first_of_vertex_;  // n + 1, into around_
  std::vector<int> around_;           // triangles round each vertex
  std::vector<bool> is_border_;       // n
};

}  // namespace myotact::measure
