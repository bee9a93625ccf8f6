#include "haptics/proxy/surface_walk.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace myotact::haptics {

namespace {

/// A walk over so many triangles is lost; a rescue crosses one or two.
constexpr int kMostSteps = 32;

NearestPoint nearest_on(const MovingSurface& surface, int local, const Vec3& p_m) {
  const geometry::TrianglePoint found = surface.closest_point(p_m, local, 0.0);
  return {local, (p_m - found.position_m).norm(), found.position_m, found.barycentric};
}

bool has_vertex(const MovingSurface& surface, int local, std::int32_t vertex) {
  const auto& vertices = surface.triangle(local).vertices;
  return std::find(vertices.begin(), vertices.end(), vertex) != vertices.end();
}

bool are_neighbours(const MovingSurface& surface, int a, int b) {
  const auto& vertices = surface.triangle(a).vertices;
  return std::any_of(vertices.begin(), vertices.end(), [&](std::int32_t v) { return has_vertex(surface, b, v); });
}

/// The angle that a triangle fills at one of its corners.
double angle_at(const MovingSurface& surface, int local, int corner) {
  const Vec3 tip_m = surface.corner_m(local, corner, 0.0);
  const Vec3 a = surface.corner_m(local, (corner + 1) % 3, 0.0) - tip_m;
  const Vec3 b = surface.corner_m(local, (corner + 2) % 3, 0.0) - tip_m;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

NearestPoint walk_to_nearest(const MovingSurface& surface, int start, const Vec3& p_m) noexcept {
  NearestPoint best = nearest_on(surface, start, p_m);
  for (int step = 0; step < kMostSteps; ++step) {
    const int from = best.local;
    for (int local = 0; local < surface.triangle_count(); ++local) {
      if (local == from || !are_neighbours(surface, from, local)) continue;
      const NearestPoint here = nearest_on(surface, local, p_m);
      if (here.distance_m < best.distance_m) best = here;
    }
    if (best.local == from) break;
  }
  return best;
}

Vec3 outward_at(const MovingSurface& surface, const NearestPoint& place) noexcept {
  const auto& b = place.barycentric;
  if (std::min({b[0], b[1], b[2]}) > 0.0) return surface.frame_W(place.local, 0.0).col(2);
  Vec3 sum = Vec3::Zero();
  int sharing = 0;
  for (int local = 0; local < surface.triangle_count(); ++local) {
    bool shares = true;  // the edge or the corner
    int corner = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(b[i] > 0.0)) continue;
      const std::int32_t vertex = surface.triangle(place.local).vertices[i];
      shares = shares && has_vertex(surface, local, vertex);
      const auto& vertices = surface.triangle(local).vertices;
      if (shares) corner = static_cast<int>(std::find(vertices.begin(), vertices.end(), vertex) - vertices.begin());
    }
    if (!shares) continue;
    const bool at_corner = std::max({b[0], b[1], b[2]}) >= 1.0;
    sum += (at_corner ? angle_at(surface, local, corner) : std::numbers::pi) * surface.frame_W(local, 0.0).col(2);
    ++sharing;
  }
  return sharing < 2 ? Vec3::Zero() : sum;
}

}  // namespace myotact::haptics
