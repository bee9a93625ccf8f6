#include "haptics/proxy/curved_surface.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/at.h"
#include "geometry/closest_point.h"

namespace myotact::haptics {

namespace {

/// Cosine of 37 degrees between a triangle and the mean of those round its corner: beyond, it is a ridge, as the
/// border of a bone or of a tendon is. Coarse muscles have 10-20 degrees.
constexpr double kRidge = 0.8;
/// Two make the point exact to 1 um on a patch of 3 mm with a radius of curvature of 10 mm, three to 10 nm.
constexpr int kIterations = 3;
/// In barycentric coordinates: the next step would be a hundredth of this one, 30 nm on an edge of 3 mm.
constexpr double kSettled = 1e-3;

}  // namespace

void CurvedSurface::resize(double radius_m) noexcept {
  shortest_m_ = kShortest * radius_m;
  ++version_;
}

void CurvedSurface::begin_tick(const MovingSurface& surface) noexcept {
  const bool is_linked = surface_ == &surface && linked_list_ == surface.list_count();
  surface_ = &surface;
  if (!is_linked || surface.largest_motion_m() > 0.0) ++version_;
}

/// Which triangles each vertex belongs to.
void CurvedSurface::link_vertices() noexcept {
  first_corner_.fill(-1);
  for (int local = surface_->triangle_count() - 1; local >= 0; --local) {
    for (int i = 2; i >= 0; --i) {
      std::int16_t& first = first_corner_[at(surface_->triangle(local).vertices[at(i)])];
      const int corner = 3 * local + i;
      next_corner_[at(corner)] = first;
      first = static_cast<std::int16_t>(corner);
    }
  }
  linked_list_ = surface_->list_count();
}

/// Normals weighted by area. Smooth: the triangles close round the vertex and none stands far off the mean.
const CurvedSurface::Vertex& CurvedSurface::vertex(int index) noexcept {
  Vertex& result = vertices_[at(index)];
  if (vertex_version_[at(index)] == version_) return result;
  vertex_version_[at(index)] = version_;
  Vec3 sum = Vec3::Zero();
  constexpr int kMost = 24;
  std::array<Vec3, kMost> areas;
  std::array<std::int32_t, kMost> after{}, before{};
  int count = 0;
  int next = first_corner_[at(index)];
  for (; next >= 0 && count < kMost; next = next_corner_[at(next)]) {
    const int local = next / 3, corner = next % 3, i = count++;
    const Vec3 tip_m = surface_->corner_m(local, corner, 1.0);
    areas[at(i)] = (surface_->corner_m(local, (corner + 1) % 3, 1.0) - tip_m)
                       .cross(surface_->corner_m(local, (corner + 2) % 3, 1.0) - tip_m);
    after[at(i)] = surface_->triangle(local).vertices[at((corner + 1) % 3)];
    before[at(i)] = surface_->triangle(local).vertices[at((corner + 2) % 3)];
    sum += areas[at(i)];
  }
  const double length = sum.norm();
  result.is_smooth = count >= 3 && next < 0 && length > 0.0;  // a fan of more than kMost is not smooth
  if (!result.is_smooth) return result;
  result.normal = sum / length;
  for (int i = 0; i < count; ++i) {
    const auto begin = before.begin(), end = before.begin() + count;
    const bool is_closed = std::count(begin, end, after[at(i)]) == 1;
    const bool is_flat = areas[at(i)].dot(result.normal) >= kRidge * areas[at(i)].norm();
    result.is_smooth = result.is_smooth && is_closed && is_flat;
  }
  return result;
}

const CurvedSurface::Patch& CurvedSurface::patch(int local) noexcept {
  if (linked_list_ != surface_->list_count()) link_vertices();
  Patch& result = patches_[at(local)];
  if (patch_version_[at(local)] == version_) return result;
  patch_version_[at(local)] = version_;
  std::array<Vertex, 3> corners;
  for (int i = 0; i < 3; ++i) {
    corners[at(i)] = vertex(surface_->triangle(local).vertices[at(i)]);
    result.corners_m[at(i)] = surface_->corner_m(local, i, 1.0);
  }
  result.height_m = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vertex &a = corners[i], &b = corners[(i + 1) % 3];
    result.rises_m[i].setZero();
    if (!a.is_smooth || !b.is_smooth) continue;
    const Vec3 chord_m = result.corners_m[(i + 1) % 3] - result.corners_m[i];
    const double share = std::min(1.0, chord_m.norm() / shortest_m_ - 1.0);
    const double rise_m = std::min((b.normal - a.normal).dot(chord_m) / 8.0, kHighest_m) * share;
    if (!(rise_m > 0.0) || !(share > 0.0)) continue;
    result.rises_m[i] = 4.0 * rise_m * (a.normal + b.normal).normalized();
    result.height_m = std::max(result.height_m, 4.0 / 3.0 * rise_m);
  }
  return result;
}

double CurvedSurface::height_m(int local) noexcept {
  return patch(local).height_m;
}

NearestPoint CurvedSurface::nearest(const NearestPoint& on_triangle, const Vec3& p_m) noexcept {
  const Patch& here = patch(on_triangle.local);
  NearestPoint result = on_triangle;
  if (!(here.height_m > 0.0)) return result;
  const auto& x_m = here.corners_m;
  const auto& rise_m = here.rises_m;
  std::array<double, 3> b = on_triangle.barycentric;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    // The patch made straight at b: again a triangle, whose corners are q(b) + dq/db (corner - b).
    const Vec3 curve_m = b[0] * b[1] * rise_m[0] + b[1] * b[2] * rise_m[1] + b[2] * b[0] * rise_m[2];
    const std::array<Vec3, 3> slope_m = {b[1] * rise_m[0] + b[2] * rise_m[2], b[0] * rise_m[0] + b[2] * rise_m[1],
                                         b[1] * rise_m[1] + b[0] * rise_m[2]};
    const geometry::TrianglePoint found = geometry::closest_point_on_triangle(
        p_m, x_m[0] + slope_m[0] - curve_m, x_m[1] + slope_m[1] - curve_m, x_m[2] + slope_m[2] - curve_m);
    const double change = std::abs(found.barycentric[0] - b[0]) + std::abs(found.barycentric[1] - b[1]);
    b = found.barycentric;
    if (change < kSettled) break;
  }
  result.barycentric = b;
  result.point_m = b[0] * x_m[0] + b[1] * x_m[1] + b[2] * x_m[2] + b[0] * b[1] * rise_m[0] + b[1] * b[2] * rise_m[1] +
                   b[2] * b[0] * rise_m[2];
  result.distance_m = (p_m - result.point_m).norm();
  return result;
}

}  // namespace myotact::haptics
