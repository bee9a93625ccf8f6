#pragma once

#include <array>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "geometry/closest_point.h"
#include "geometry/triangle_mesh.h"

namespace myotact::geometry {

/// A place on a surface.
struct SurfacePlace {
  int triangle = -1;  // -1: none within the radius
  TrianglePoint point;
  double distance_m = std::numeric_limits<double>::infinity();
};

/// Bounding boxes over the triangles of a surface whose vertices move but whose triangles stay. Built once; then
/// refit() follows the motion. Queries are const, allocate nothing and may run in several threads at once.
class TriangleTree {
 public:
  TriangleTree() = default;
  /// Copies the triangles and splits them by their places now.
  explicit TriangleTree(const TriangleMesh& mesh);

  int triangle_count() const { return static_cast<int>(triangles_.size()); }
  const std::array<int, 3>& triangle(int t) const { return triangles_[static_cast<std::size_t>(t)]; }

  /// Boxes around the triangles at these vertices. Allocates nothing.
  void refit(std::span<const Vec3> positions_m) noexcept { refit(positions_m, positions_m); }
  /// Boxes that hold the triangles at both frames, hence everywhere on the straight way between.
  void refit(std::span<const Vec3> previous_m, std::span<const Vec3> current_m) noexcept;

  /// Closest place within `radius_m` on the surface at `positions_m`, which must be those (or one of those) last
  /// fitted.
  SurfacePlace nearest(const Vec3& p, std::span<const Vec3> positions_m,
                       double radius_m = std::numeric_limits<double>::infinity()) const noexcept;

  /// Calls visit(triangle) for every triangle whose leaf's box comes within the radius of p. `visit` returns the radius
  /// to go on with (the same, or smaller once enough was found); nearer boxes come first.
  template <class Visit>
  void visit_within(const Vec3& p, double radius_m, Visit&& visit) const {
    if (boxes_.empty()) return;
    std::array<std::pair<int, double>, kStack> stack;  // node, squared distance of its box
    int top = 0;
    stack[0] = {0, squared_distance(0, p)};
    while (top >= 0) {
      const auto [node, distance_m2] = stack[static_cast<std::size_t>(top--)];
      if (distance_m2 > radius_m * radius_m) continue;
      const Node& here = nodes_[static_cast<std::size_t>(node)];
      if (here.count > 0) {
        for (int i = 0; i < here.count; ++i) radius_m = visit(order_[static_cast<std::size_t>(here.first + i)]);
        continue;
      }
      std::pair<int, double> near{node + 1, squared_distance(node + 1, p)};
      std::pair<int, double> far{here.first, squared_distance(here.first, p)};
      if (far.second < near.second) std::swap(near, far);
      stack[static_cast<std::size_t>(++top)] = far;
      stack[static_cast<std::size_t>(++top)] = near;
    }
  }

 private:
  /// Leaf: count > 0 triangles from order_[first]. Inner: children are the next node and node `first`.
  struct Node {
    int first = 0;
    int count = 0;
  };
  /// The tree is split at the median, so its depth is at most log2 of the triangles; one waits per level.
  static constexpr std::size_t kStack = 64;
  static constexpr int kLeafTriangles = 4;

  int build(int first, int count, const std::vector<Vec3>& centroids);
  double squared_distance(int node, const Vec3& p) const noexcept {
    return boxes_[static_cast<std::size_t>(node)].squaredExteriorDistance(p);
  }

  std::vector<std::array<int, 3>> triangles_;
  std::vector<int> order_;  // triangles, leaf by leaf
  std::vector<Node> nodes_;
  std::vector<Eigen::AlignedBox3d> boxes_;  // one a node
};

}  // namespace myotact::geometry
