#include "prepare/field/signed_distance.h"

#include <algorithm>
#include <cmath>

namespace myotact::prepare {

namespace {

/// A barycentric coordinate below this lies on the opposite edge: rounding of the projection onto a face.
constexpr double kOnEdge = 1e-9;

/// The triangle across each edge. An edge with one triangle only is its own neighbour.
std::vector<std::array<int, 3>> neighbours_of(const geometry::TriangleMesh& mesh) {
  struct Side {
    int low, high, triangle, edge;
  };
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t e = 0; e < 3; ++e) {
      const auto [low, high] = std::minmax(mesh.triangles[t][e], mesh.triangles[t][(e + 1) % 3]);
      sides.push_back({low, high, static_cast<int>(t), static_cast<int>(e)});
    }
  }
  const auto same_edge = [](const Side& a, const Side& b) { return a.low == b.low && a.high == b.high; };
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  std::vector<std::array<int, 3>> neighbours(mesh.triangles.size());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool first = i + 1 < sides.size() && same_edge(sides[i], sides[i + 1]);
    const bool second = i > 0 && same_edge(sides[i], sides[i - 1]);
    const Side& other = first ? sides[i + 1] : second ? sides[i - 1] : sides[i];
    neighbours[static_cast<std::size_t>(sides[i].triangle)][static_cast<std::size_t>(sides[i].edge)] = other.triangle;
  }
  return neighbours;
}

}  // namespace

SignedDistance::SignedDistance(const geometry::TriangleMesh& surface)
    : surface_(surface),
      tree_(surface_),
      volume_m3_(geometry::enclosed_volume_m3(surface)),
      vertex_normals_(surface.positions_m.size(), Vec3::Zero()),
      face_neighbours_(neighbours_of(surface)) {
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
    const auto across = static_cast<std::size_t>(face_neighbours_[t][(k + 1) % 3]);  // the edge opposite corner k
    return face_normals_[t] + face_normals_[across];
  }
  return face_normals_[t];
}

}  // namespace myotact::prepare
