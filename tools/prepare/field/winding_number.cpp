#include "prepare/field/winding_number.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

#include "geometry/depth_inside.h"
#include "geometry/triangle_tree.h"
#include "prepare/field/level_set.h"
#include "prepare/surface/surface_pieces.h"

namespace myotact::prepare {

namespace {

/// Clusters farther away than this multiple of their radius are taken as one.
constexpr double kFar = 2.0;
constexpr int kLeafTriangles = 4;

}  // namespace

WindingNumber::WindingNumber(const geometry::TriangleMesh& surface) : surface_(surface) {
  order_.resize(surface.triangles.size());
  std::iota(order_.begin(), order_.end(), 0);
  if (!order_.empty()) build(0, static_cast<int>(order_.size()));
}

int WindingNumber::build(int first, int count) {
  const int index = static_cast<int>(clusters_.size());
  clusters_.emplace_back();
  Cluster cluster;
  Eigen::AlignedBox3d box;
  double weights = 0.0;
  const auto corner = [&](int t, std::size_t k) -> const Vec3& {
    return surface_.positions_m[static_cast<std::size_t>(surface_.triangles[static_cast<std::size_t>(t)][k])];
  };
  const auto centre = [&](int t) -> Vec3 { return (corner(t, 0) + corner(t, 1) + corner(t, 2)) / 3.0; };
  const auto begin = order_.begin() + first, end = begin + count;
  for (auto t = begin; t != end; ++t) {
    const Vec3 area = 0.5 * (corner(*t, 1) - corner(*t, 0)).cross(corner(*t, 2) - corner(*t, 0));
    cluster.area += area;
    cluster.middle += area.norm() * centre(*t);
    weights += area.norm();
    box.extend(centre(*t));
  }
  cluster.middle = weights > 0.0 ? Vec3(cluster.middle / weights) : box.center();
  for (auto t = begin; t != end; ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      cluster.radius = std::max(cluster.radius, (corner(*t, k) - cluster.middle).norm());
    }
  }
  if (count <= kLeafTriangles) {
    cluster.first = first;
    cluster.count = count;
  } else {
    Eigen::Index axis = 0;
    box.sizes().maxCoeff(&axis);
    std::nth_element(begin, begin + count / 2, end, [&](int a, int b) {
      const double at_a = centre(a)[axis], at_b = centre(b)[axis];
      return at_a < at_b || (at_a == at_b && a < b);
    });
    build(first, count / 2);
    cluster.first = build(first + count / 2, count - count / 2);
  }
  clusters_[static_cast<std::size_t>(index)] = cluster;
  return index;
}

double WindingNumber::sum(int cluster, const Vec3& p) const {
  const Cluster& here = clusters_[static_cast<std::size_t>(cluster)];
  const Vec3 away = here.middle - p;
  const double distance = away.norm();
  if (distance > kFar * here.radius) {
    return here.area.dot(away) / (4.0 * std::numbers::pi * distance * distance * distance);
  }
  if (here.count == 0) return sum(cluster + 1, p) + sum(here.first, p);
  double angle = 0.0;
  for (int i = 0; i < here.count; ++i) {
    const auto& [a, b, c] =
        surface_.triangles[static_cast<std::size_t>(order_[static_cast<std::size_t>(here.first + i)])];
    const auto at = [&](int v) -> Vec3 { return surface_.positions_m[static_cast<std::size_t>(v)] - p; };
    angle += geometry::solid_angle(at(a), at(b), at(c));
  }
  return angle / (4.0 * std::numbers::pi);
}

geometry::TriangleMesh surface_of_winding(const geometry::TriangleMesh& surface, double spacing_m) {
  const WindingNumber winding(surface);
  const geometry::TriangleTree tree(surface);
  const auto inside_is_negative = [&](const Vec3& p) {
    const double distance_m = tree.nearest(p, surface.positions_m).distance_m;
    return winding(p) > 0.5 ? -distance_m : distance_m;
  };
  Eigen::AlignedBox3d box;
  for (const Vec3& p : surface.positions_m) box.extend(p);
  geometry::TriangleMesh largest;
  for (geometry::TriangleMesh& piece : pieces_of(extract_level_set(inside_is_negative, box, spacing_m))) {
    if (piece.triangles.size() > largest.triangles.size()) largest = std::move(piece);
  }
  return largest;
}

}  // namespace myotact::prepare
