#include "measure/probe/surface_side.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "core/at.h"
#include "geometry/depth_inside.h"

namespace myotact::measure {

namespace {

double angle_rad(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// An edge with the triangles on it: `along` goes from its smaller to its greater vertex, `against` the other way.
struct Edge {
  int low = 0;
  int high = 0;
  bool along = true;

  bool operator<(const Edge& other) const { return low != other.low ? low < other.low : high < other.high; }
};

/// Calls visit(edge, triangles on it, whether it is one between two triangles that face the same way).
template <class Visit>
void for_each_edge(const geometry::TriangleMesh& mesh, Visit&& visit) {
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const int from = triangle[i], to = triangle[(i + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), from < to});
    }
  }
  std::sort(edges.begin(), edges.end());
  for (auto first = edges.begin(); first != edges.end();) {
    const auto last = std::upper_bound(first, edges.end(), *first);
    visit(*first, last - first, last - first == 2 && first->along != (first + 1)->along);
    first = last;
  }
}

}  // namespace

SurfaceDefects find_defects(const geometry::TriangleMesh& mesh) {
  SurfaceDefects defects;
  for (const auto& triangle : mesh.triangles) {
    const Vec3 &a = mesh.positions_m[at(triangle[0])], &b = mesh.positions_m[at(triangle[1])],
               &c = mesh.positions_m[at(triangle[2])];
    if (!((b - a).cross(c - a).squaredNorm() > 0.0)) ++defects.triangles_without_area;
  }
  for_each_edge(mesh, [&](const Edge&, auto count, bool is_manifold) {
    defects.border_edges += count == 1 ? 1 : 0;
    defects.non_manifold_edges += count > 1 && !is_manifold ? 1 : 0;
  });
  return defects;
}

SurfaceSide::SurfaceSide(const geometry::TriangleMesh& mesh)
    : mesh_(mesh),
      tree_(mesh),
      first_of_vertex_(mesh.positions_m.size() + 1, 0),
      around_(3 * mesh.triangles.size()),
      is_border_(mesh.positions_m.size(), false) {
  for_each_edge(mesh, [&](const Edge& edge, auto count, bool is_manifold) {
    closed_ = closed_ && is_manifold;
    if (count == 1) is_border_[at(edge.low)] = is_border_[at(edge.high)] = true;
  });
  for (const auto& triangle : mesh.triangles) {
    for (const int vertex : triangle) ++first_of_vertex_[at(vertex) + 1];
  }
  for (std::size_t i = 1; i < first_of_vertex_.size(); ++i) first_of_vertex_[i] += first_of_vertex_[i - 1];
  std::vector<int> next(first_of_vertex_.begin(), first_of_vertex_.end() - 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const int vertex : mesh.triangles[t]) around_[at(next[at(vertex)]++)] = static_cast<int>(t);
  }
}

/// Not a unit vector; zero at the border of an open surface.
Vec3 SurfaceSide::outward(const geometry::SurfacePlace& place, const std::vector<Vec3>& x_m) const {
  const auto& corners = mesh_.triangles[at(place.triangle)];
  const auto& b = place.point.barycentric;
  const auto shares = [&](const std::array<int, 3>& triangle) {  // the nearest face, edge or corner
    for (std::size_t i = 0; i < 3; ++i) {
      if (b[i] > 0.0 && std::find(triangle.begin(), triangle.end(), corners[i]) == triangle.end()) return false;
    }
    return true;
  };
  bool on_border = std::min({b[0], b[1], b[2]}) <= 0.0;
  for (std::size_t i = 0; i < 3; ++i) on_border = on_border && (b[i] <= 0.0 || is_border_[at(corners[i])]);
  if (on_border) return Vec3::Zero();
  const std::size_t on = b[0] > 0.0 ? 0 : (b[1] > 0.0 ? 1 : 2);
  const bool at_corner = b[on] >= 1.0;
  const int vertex = corners[on];
  Vec3 sum = Vec3::Zero();
  for (int i = first_of_vertex_[at(vertex)]; i < first_of_vertex_[at(vertex) + 1]; ++i) {
    const auto& triangle = mesh_.triangles[at(around_[at(i)])];
    if (!shares(triangle)) continue;
    const auto k = static_cast<std::size_t>(std::find(triangle.begin(), triangle.end(), vertex) - triangle.begin());
    const Vec3 u = x_m[at(triangle[(k + 1) % 3])] - x_m[at(vertex)];
    const Vec3 v = x_m[at(triangle[(k + 2) % 3])] - x_m[at(vertex)];
    const Vec3 normal = u.cross(v);
    if (normal.squaredNorm() > 0.0) sum += normal.normalized() * (at_corner ? angle_rad(u, v) : 1.0);
  }
  return sum;
}

bool SurfaceSide::inside(const Vec3& p, const std::vector<Vec3>& positions_m) const {
  const geometry::SurfacePlace place = tree_.nearest(p, positions_m);
  if (place.triangle < 0) return false;
  const bool behind = outward(place, positions_m).dot(p - place.point.position_m) < 0.0;
  return behind && (!closed_ || geometry::winding_number(mesh_, positions_m, p) > 0.5);
}

}  // namespace myotact::measure
