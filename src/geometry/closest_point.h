#pragma once

#include <array>

#include "core/vector.h"

namespace myotact::geometry {

/// A point of a triangle: position = sum barycentric_i corner_i.
struct TrianglePoint {
  Vec3 position_m = Vec3::Zero();
  std::array<double, 3> barycentric{};  // >= 0, sum 1
};

/// Closest point of triangle abc to p, exact on faces, edges and corners (Ericson, Real-Time Collision
/// Detection 5.1.5). Real-time safe.
TrianglePoint closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) noexcept;

}  // namespace myotact::geometry
