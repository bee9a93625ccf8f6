#include "prepare/remesh/triangle_crossing.h"

#include <algorithm>
#include <cstddef>

#include <Eigen/Geometry>

#include "prepare/cgal_mesh.h"

namespace myotact::prepare {

namespace {

Kernel::Point_3 to_point(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

double cross_2d(const Vec3& a, const Vec3& b, const Vec3& c, int u, int v) {
  return (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
}

/// Whether pq and ab cross or touch in the plane of the coordinates u and v.
bool segments_meet_2d(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const std::array<int, 2>& uv) {
  const auto [u, v] = uv;
  for (const int k : uv) {
    if (std::max(p[k], q[k]) < std::min(a[k], b[k]) || std::max(a[k], b[k]) < std::min(p[k], q[k])) return false;
  }
  return cross_2d(a, b, p, u, v) * cross_2d(a, b, q, u, v) <= 0.0 &&
         cross_2d(p, q, a, u, v) * cross_2d(p, q, b, u, v) <= 0.0;
}

/// Segment and triangle in one plane.
bool segment_meets_in_plane(const Vec3& p, const Vec3& q, const Corners& t) {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]).cwiseAbs();
  Eigen::Index drop = 0;
  normal.maxCoeff(&drop);
  const std::array<int, 2> uv{drop == 0 ? 1 : 0, drop == 2 ? 1 : 2};
  for (std::size_t k = 0; k < 3; ++k) {
    if (segments_meet_2d(p, q, t[k], t[(k + 1) % 3], uv)) return true;
  }
  int positive = 0, negative = 0;  // p inside?
  for (std::size_t k = 0; k < 3; ++k) {
    const double side = cross_2d(t[k], t[(k + 1) % 3], p, uv[0], uv[1]);
    positive += side >= 0.0 ? 1 : 0;
    negative += side <= 0.0 ? 1 : 0;
  }
  return positive == 3 || negative == 3;
}

}  // namespace

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return static_cast<int>(CGAL::orientation(to_point(a), to_point(b), to_point(c), to_point(d)));
}

bool segment_meets(const Vec3& p, const Vec3& q, const Corners& t) {
  const int side_p = orientation(t[0], t[1], t[2], p);
  const int side_q = orientation(t[0], t[1], t[2], q);
  if (side_p * side_q > 0) return false;
  if (side_p == 0 && side_q == 0) return segment_meets_in_plane(p, q, t);
  const int a = orientation(p, q, t[0], t[1]), b = orientation(p, q, t[1], t[2]), c = orientation(p, q, t[2], t[0]);
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

bool triangles_meet(const Corners& a, const Corners& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (segment_meets(a[k], a[(k + 1) % 3], b) || segment_meets(b[k], b[(k + 1) % 3], a)) return true;
  }
  return false;
}

}  // namespace myotact::prepare
