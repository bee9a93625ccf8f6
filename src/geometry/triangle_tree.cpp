#include "geometry/triangle_tree.h"

#include <algorithm>
#include <numeric>

#include "core/at.h"

namespace myotact::geometry {

TriangleTree::TriangleTree(const TriangleMesh& mesh) : triangles_(mesh.triangles) {
  if (triangles_.empty()) return;
  std::vector<Vec3> centroids;
  centroids.reserve(triangles_.size());
  for (const auto& [a, b, c] : triangles_) {
    centroids.push_back((mesh.positions_m[at(a)] + mesh.positions_m[at(b)] + mesh.positions_m[at(c)]) / 3.0);
  }
  order_.resize(triangles_.size());
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(triangles_.size());
  build(0, triangle_count(), centroids);
  boxes_.resize(nodes_.size());
  refit(mesh.positions_m);
}

/// Splits at the median along the longest side of the centroids' box; equal centroids fall apart by their index, so
/// that the tree depends on the mesh alone.
int TriangleTree::build(int first, int count, const std::vector<Vec3>& centroids) {
  const int node = static_cast<int>(nodes_.size());
  nodes_.push_back({first, count});
  if (count <= kLeafTriangles) return node;
  Eigen::AlignedBox3d box;
  for (int i = first; i < first + count; ++i) box.extend(centroids[at(order_[at(i)])]);
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const int half = count / 2;
  std::nth_element(order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count,
                   [&](int a, int b) {
                     const double left = centroids[at(a)][axis], right = centroids[at(b)][axis];
                     return left != right ? left < right : a < b;
                   });
  build(first, half, centroids);
  const int right_child = build(first + half, count - half, centroids);
  nodes_[at(node)] = {right_child, 0};
  return node;
}

void TriangleTree::refit(std::span<const Vec3> previous_m, std::span<const Vec3> current_m) noexcept {
  // Children come after their parent, so a walk from the end finds them done.
  for (int node = static_cast<int>(nodes_.size()) - 1; node >= 0; --node) {
    const Node& here = nodes_[at(node)];
    if (here.count == 0) {
      boxes_[at(node)] = boxes_[at(node + 1)].merged(boxes_[at(here.first)]);
      continue;
    }
    Eigen::AlignedBox3d box;
    for (int i = here.first; i < here.first + here.count; ++i) {
      for (const int vertex : triangles_[at(order_[at(i)])]) {
        box.extend(previous_m[at(vertex)]);
        box.extend(current_m[at(vertex)]);
      }
    }
    boxes_[at(node)] = box;
  }
}

SurfacePlace TriangleTree::nearest(const Vec3& p, std::span<const Vec3> positions_m, double radius_m) const noexcept {
  SurfacePlace best;
  double reach_m = radius_m;
  visit_within(p, radius_m, [&](int t) {
    const auto& [a, b, c] = triangles_[at(t)];
    const TrianglePoint point =
        closest_point_on_triangle(p, positions_m[at(a)], positions_m[at(b)], positions_m[at(c)]);
    const double distance_m = (point.position_m - p).norm();
    const bool nearer = distance_m < best.distance_m || (distance_m == best.distance_m && t < best.triangle);
    if (distance_m <= reach_m && nearer) {
      best = {t, point, distance_m};
      reach_m = distance_m;
    }
    return reach_m;
  });
  return best;
}

}  // namespace myotact::geometry
