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

}  // namespace

PseudoNormals::PseudoNormals(const TriangleMesh& surface)
    : triangles_(surface.triangles), corners_(surface.positions_m.size(), Vec3::Zero()) {
  for (const auto& t : triangles_) {
    const std::array<Vec3, 3> p{surface.positions_m[myotact::at(t[0])], surface.positions_m[myotact::at(t[1])],
                                surface.positions_m[myotact::at(t[2])]};
    const Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
    faces_.push_back(normal);
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 a = p[(c + 1) % 3] - p[c], b = p[(c + 2) % 3] - p[c];
      corners_[myotact::at(t[c])] += std::atan2(a.cross(b).norm(), a.dot(b)) * normal;
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

}  // namespace myotact::geometry
