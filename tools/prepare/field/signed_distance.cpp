#include "prepare/field/signed_distance.h"

#include <cmath>

#include "prepare/surface/edge_table.h"

namespace myotact::prepare {

namespace {

/// A barycentric coordinate below this lies on the opposite edge: rounding of the projection onto a face.
constexpr double kOnEdge = 1e-9;

}  // namespace

SignedDistance::SignedDistance(const geometry::TriangleMesh& surface)
    : surface_(surface),
      tree_(surface_),
      volume_m3_(geometry::enclosed_volume_m3(surface)),
      vertex_normals_(surface.positions_m.size(), Vec3::Zero()),
      opposite_sides_(opposite_sides(surface)) {
  for (const auto& corners : surface_.triangles) {
    std::array<Vec3, 3> x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = surface_.positions_m[static_cast<std::size_t>(corners[k])];
    const Vec3 normal = (x[1] - x[0]).cross(x[2] - x[0]).normalized();
    face_normals_.push_back(normal);
    for (std::size_t k = 0; k < 3; ++k) {
      box_.extend(x[k]);
      const Vec3 u = x[(k + 1) % 3] - x[k], v = x[(k + 2) % 3] - x[k];
      vertex_normals_[static_cast<std::size_t>(corners[k])] += std::atan2(u.cross(v).norm(), u.dot(v)) * normal;
    }
  }
}

std::pair<double, Vec3> SignedDistance::nearest(const Vec3& p) const {
  const geometry::SurfacePlace place = tree_.nearest(p, surface_.positions_m);
  const Vec3 normal = normal_at(place.triangle, place.point.barycentric);
  const double sign = normal.dot(p - place.point.position_m) < 0.0 ? -1.0 : 1.0;
  return {sign * place.distance_m, place.point.position_m};
}

Vec3 SignedDistance::normal_at(int triangle, const std::array<double, 3>& barycentric) const {
  const auto t = static_cast<std::size_t>(triangle);
  for (std::size_t k = 0; k < 3; ++k) {
    if (barycentric[k] >= 1.0 - kOnEdge) return vertex_normals_[static_cast<std::size_t>(surface_.triangles[t][k])];
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (barycentric[k] > kOnEdge) continue;
    const int across = opposite_sides_[3 * t + (k + 1) % 3];  // of the side opposite corner k
    return face_normals_[t] + face_normals_[static_cast<std::size_t>(across / 3)];
  }
  return face_normals_[t];
}

}  // namespace myotact::prepare
