#include "geometry/depth_inside.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "geometry/closest_point.h"

namespace myotact::geometry {

double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  const double height = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  return 2.0 * std::atan2(a.dot(b.cross(c)), height);
}

double winding_number(const TriangleMesh& surface, std::span<const Vec3> positions_m, const Vec3& p) {
  double angle_sr = 0.0;
  for (const auto& t : surface.triangles) {
    angle_sr +=
        solid_angle(positions_m[static_cast<std::size_t>(t[0])] - p, positions_m[static_cast<std::size_t>(t[1])] - p,
                    positions_m[static_cast<std::size_t>(t[2])] - p);
  }
  return angle_sr / (4.0 * std::numbers::pi);
}

double depth_inside_m(const TriangleMesh& surface, const Vec3& p) {
  Eigen::AlignedBox3d box;
  for (const Vec3& vertex : surface.positions_m) box.extend(vertex);
  if (!box.contains(p)) return 0.0;
  double angle = 0.0, nearest_m = std::numeric_limits<double>::infinity();
  for (const auto& t : surface.triangles) {
    const Vec3 &a = surface.positions_m[static_cast<std::size_t>(t[0])],
               &b = surface.positions_m[static_cast<std::size_t>(t[1])],
               &c = surface.positions_m[static_cast<std::size_t>(t[2])];
    angle += solid_angle(a - p, b - p, c - p);
    nearest_m = std::min(nearest_m, (closest_point_on_triangle(p, a, b, c).position_m - p).norm());
  }
  return angle > 2.0 * std::numbers::pi ? nearest_m : 0.0;  // 4 pi inside, 0 outside
}

}  // namespace myotact::geometry
