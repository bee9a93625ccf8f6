#include "geometry/pseudo_normals.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "core/at.h"

namespace myotact::geometry {
namespace {

/// A barycentric coordinate below this counts as zero when a place is classified as face, edge or corner.
constexpr double kOnEdge = 1e-9;

Vec3 face_normal(const std::array<Vec3, 3>& corners) {
  return (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
}

/// Angle at a corner of a triangle [rad].
double angle_rad(const std::array<Vec3, 3>& corners, std::size_t corner) {
  const Vec3 a = corners[(corner + 1) % 3] - corners[corner], b = corners[(corner + 2) % 3] - corners[corner];
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

std::array<Vec3, 3> corners_of(const std::array<int, 3>& triangle, std::span<const Vec3> positions_m) {
  return {positions_m[at(triangle[0])], positions_m[at(triangle[1])], positions_m[at(triangle[2])]};
}

}  // namespace

PseudoNormals::PseudoNormals(const TriangleMesh& surface)
    : triangles_(surface.triangles), corners_(surface.positions_m.size(), Vec3::Zero()) {
  for (const auto& t : triangles_) {
    const std::array<Vec3, 3> p = corners_of(t, surface.positions_m);
    const Vec3 normal = face_normal(p);
    faces_.push_back(normal);
    for (std::size_t c = 0; c < 3; ++c) {
      corners_[myotact::at(t[c])] += angle_rad(p, c) * normal;
      edges_.try_emplace(std::minmax(t[c], t[(c + 1) % 3]), Vec3::Zero()).first->second += normal;
    }
  }
}

Vec3 PseudoNormals::at(const SurfacePlace& place) const {
  const std::array<int, 3>& t = triangles_[myotact::at(place.triangle)];
  for (std::size_t c = 0; c < 3; ++c) {
    if (place.point.barycentric[c] > 1.0 - kOnEdge) return corners_[myotact::at(t[c])];
  }
  for (std::size_t c = 0; c < 3; ++c) {
    if (place.point.barycentric[c] < kOnEdge) return edges_.at(std::minmax(t[(c + 1) % 3], t[(c + 2) % 3]));
  }
  return faces_[myotact::at(place.triangle)];
}

std::vector<std::vector<int>> triangles_around(const TriangleTree& surface, std::size_t vertices) {
  std::vector<std::vector<int>> around(vertices);
  for (int t = 0; t < surface.triangle_count(); ++t) {
    for (const int vertex : surface.triangle(t)) around[at(vertex)].push_back(t);
  }
  return around;
}

Vec3 pseudo_normal(const TriangleTree& surface, std::span<const std::vector<int>> around,
                   std::span<const Vec3> positions_m, const SurfacePlace& place) {
  const std::array<int, 3>& here = surface.triangle(place.triangle);
  const auto far = [&](std::size_t corner) { return place.point.barycentric[corner] < kOnEdge; };
  const auto corner = static_cast<std::size_t>(far(0) ? (far(1) ? 2 : 1) : 0);  // that is not far
  const bool on_corner = far((corner + 1) % 3) && far((corner + 2) % 3);
  Vec3 sum = Vec3::Zero();
  for (const int t : around[at(here[corner])]) {
    const std::array<int, 3>& triangle = surface.triangle(t);
    const auto index = [&](int vertex) { return std::find(triangle.begin(), triangle.end(), vertex); };
    bool meets = true;  // the place lies on all corners that are not far
    for (std::size_t c = 0; c < 3; ++c) meets = meets && (far(c) || index(here[c]) != triangle.end());
    if (!meets) continue;
    const std::array<Vec3, 3> p = corners_of(triangle, positions_m);
    const auto which = static_cast<std::size_t>(index(here[corner]) - triangle.begin());
    sum += (on_corner ? angle_rad(p, which) : 1.0) * face_normal(p);
  }
  return sum;
}

}  // namespace myotact::geometry
