#include "geometry/polygon.h"

#include <algorithm>

#include <Eigen/Geometry>

// Every triangle taken off is counter-clockwise and the signed areas add up to the polygon's. A simple polygon winds
// once around its inside, so triangles that are all counter-clockwise cannot overlap: only one that is not shows that
// the polygon crosses itself.

namespace myotact::geometry {

namespace {

Vec3 position_of(const TriangleMesh& mesh, int vertex) {
  return mesh.positions_m[static_cast<std::size_t>(vertex)];
}

/// Twice the area vector, by Newell's sum. From the first corner, so that a mesh far away loses nothing.
Vec3 normal_of(std::span<const int> corners, const TriangleMesh& mesh) {
  const Vec3 origin = position_of(mesh, corners[0]);
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    sum += (position_of(mesh, corners[i]) - origin).cross(position_of(mesh, corners[i + 1]) - origin);
  }
  return sum;
}

}  // namespace

/// 1: left of the way from one to the other, -1: right. 0 also where rounding alone would decide.
int PolygonCutter::side(const Corner& from, const Corner& to, const Corner& point) {
  constexpr double kStraight = 1e-12;  // sine of the angle; a thousand roundings of coordinates near the polygon
  const double ux = to.x - from.x, uy = to.y - from.y;
  const double vx = point.x - from.x, vy = point.y - from.y;
  const double cross = ux * vy - uy * vx;
  if (cross * cross <= kStraight * kStraight * (ux * ux + uy * uy) * (vx * vx + vy * vy)) return 0;
  return cross > 0.0 ? 1 : -1;
}

/// Leaves out the axis that the normal is nearest to, so that no coordinate is rounded.
void PolygonCutter::place(std::span<const int> corners, const TriangleMesh& mesh) {
  const Vec3 normal = normal_of(corners, mesh);
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  Eigen::Index x = (axis + 1) % 3, y = (axis + 2) % 3;
  if (normal[axis] < 0.0) std::swap(x, y);
  const Vec3 origin = position_of(mesh, corners[0]);
  corners_.clear();
  for (const int vertex : corners) {
    const Vec3 offset = position_of(mesh, vertex) - origin;
    corners_.push_back({vertex, offset[x], offset[y], 0, false});
  }
}

/// Sets the orientation at a corner, and whether nothing of the polygon lies in its triangle.
void PolygonCutter::classify(std::size_t index) {
  const Corner& a = corners_[before(index)];
  const Corner& c = corners_[after(index)];
  Corner& b = corners_[index];
  b.orientation = side(a, b, c);
  b.ear = b.orientation > 0;
  if (!b.ear) return;
  const auto same_place = [](const Corner& p, const Corner& q) { return p.x == q.x && p.y == q.y; };
  b.ear = std::none_of(corners_.begin(), corners_.end(), [&](const Corner& p) {
    // A corner to the left lies in the triangle only when one that is not does too.
    if (p.orientation > 0 || same_place(p, a) || same_place(p, b) || same_place(p, c)) return false;
    return side(a, b, p) >= 0 && side(b, c, p) >= 0 && side(c, a, p) >= 0;
  });
}

void PolygonCutter::classify_all() {
  for (std::size_t i = 0; i < corners_.size(); ++i)
    corners_[i].orientation = side(corners_[before(i)], corners_[i], corners_[after(i)]);
  for (std::size_t i = 0; i < corners_.size(); ++i) classify(i);
}

template <class Fits>
std::size_t PolygonCutter::first(Fits&& fits) const {
  for (std::size_t i = 1; i <= corners_.size(); ++i) {
    if (fits(corners_[i % corners_.size()])) return i % corners_.size();
  }
  return corners_.size();
}

/// The corner to take off next: an ear; without one a straight corner, which overlaps nothing.
std::size_t PolygonCutter::choose() {
  const auto is_ear = [](const Corner& corner) { return corner.ear; };
  std::size_t index = first(is_ear);
  if (index == corners_.size() && fresh_starts_ > 0) {
    // What stood in the way by touching only may be gone.
    --fresh_starts_;
    classify_all();
    index = first(is_ear);
    if (index == corners_.size()) fresh_starts_ = 0;
  }
  if (index == corners_.size()) index = first([](const Corner& corner) { return corner.orientation == 0; });
  if (index == corners_.size()) index = first([](const Corner& corner) { return corner.orientation > 0; });
  return index % corners_.size();
}

void PolygonCutter::take_off(std::size_t index, TriangleMesh& mesh) {
  mesh.triangles.push_back({corners_[before(index)].vertex, corners_[index].vertex, corners_[after(index)].vertex});
  corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(index));
  const std::size_t next = index % corners_.size();
  for (const std::size_t changed : {before(next), next}) classify(changed);
}

bool PolygonCutter::cut(std::span<const int> corners, TriangleMesh& mesh) {
  if (corners.size() == 3) {
    mesh.triangles.push_back({corners[0], corners[1], corners[2]});
    return true;
  }
  place(corners, mesh);
  classify_all();
  fresh_starts_ = 32;  // enough for outlines that touch themselves; bounds the work for those that are a tangle
  bool simple = true;
  while (corners_.size() > 3) {
    const std::size_t index = choose();
    simple = simple && (corners_[index].ear || corners_[index].orientation == 0);
    take_off(index, mesh);
  }
  simple = simple && corners_[1].orientation >= 0;
  take_off(1, mesh);
  return simple;
}

}  // namespace myotact::geometry
