#include "geometry/signed_distance.h"

namespace myotact::geometry {
namespace {

/// Nearer than this the direction from the surface to the point is rounding; the normal there is the direction.
constexpr double kOnSurface_m = 1e-7;

}  // namespace

SignedDistance::SignedDistance(const TriangleMesh& surface)
    : positions_m_(surface.positions_m), tree_(surface), normals_(surface) {
  tree_.refit(positions_m_);
  for (const Vec3& p : positions_m_) box_.extend(p);
}

SignedPlace SignedDistance::nearest(const Vec3& p, double radius_m) const noexcept {
  const SurfacePlace place = tree_.nearest(p, positions_m_, radius_m);
  if (place.triangle < 0) return {};
  const Vec3 normal = normals_.at(place);
  const Vec3 way = p - place.point.position_m;
  const bool inside = way.dot(normal) < 0.0;
  SignedPlace result{true, inside ? -place.distance_m : place.distance_m, normal.normalized()};
  if (place.distance_m > kOnSurface_m) result.outward = way / result.distance_m;
  return result;
}

}  // namespace myotact::geometry
