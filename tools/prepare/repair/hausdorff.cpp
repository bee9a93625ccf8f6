#include "prepare/repair/hausdorff.h"

#include <algorithm>
#include <cmath>

#include "geometry/triangle_tree.h"
#include "prepare/repair/surface_surgery.h"
#include "prepare/surface/edge_table.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;

/// Grid step, part of the tolerance, and most steps along an edge: a tenth of the body at that.
constexpr double kStep = 0.5;
constexpr int kMostSteps = 40;
constexpr double kWhole = 1e9;  // a step that no triangle needs two of
/// Triangles with all corners inside united pieces are hidden; the grid on them only has to catch a wrong union.
constexpr double kHidden = 10.0;
/// A triangle whose corners lie this near to one triangle of the other surface, part of the tolerance, lies as near
/// everywhere, because the distance to a convex set is convex: its corners are enough.
constexpr double kNear = 0.1;

bool corners_near(const TriangleMesh& mesh, int triangle, const std::array<Vec3, 3>& other, double reach) {
  const auto& corners = mesh.triangles[at(triangle)];
  return std::all_of(corners.begin(), corners.end(), [&](int v) {
    const Vec3& p = mesh.positions_m[at(v)];
    return (geometry::closest_point_on_triangle(p, other[0], other[1], other[2]).position_m - p).norm() <= reach;
  });
}

std::array<Vec3, 3> corners_of(const TriangleMesh& mesh, int triangle) {
  const auto& [a, b, c] = mesh.triangles[at(triangle)];
  return {mesh.positions_m[at(a)], mesh.positions_m[at(b)], mesh.positions_m[at(c)]};
}

/// For each input triangle one of the repaired surface that comes from it or from what was kept instead, or -1.
std::vector<int> images_of(const RepairJob& job) {
  std::vector<int> image(job.left_out.size(), -1);
  for (int t = 0; t < static_cast<int>(job.face_source.size()); ++t) {
    if (job.face_source[at(t)] >= 0) image[at(job.face_source[at(t)])] = t;
  }
  for (auto copy = job.copies.rbegin(); copy != job.copies.rend(); ++copy) {
    if (copy->first >= 0 && copy->second >= 0) image[at(copy->first)] = image[at(copy->second)];
  }
  return image;
}

/// Calls visit(place) on a grid over the triangle, its corners included.
template <class Visit>
void visit_places(const TriangleMesh& mesh, int triangle, double step, Visit&& visit) {
  const auto& [ia, ib, ic] = mesh.triangles[at(triangle)];
  const Vec3 &a = mesh.positions_m[at(ia)], &b = mesh.positions_m[at(ib)], &c = mesh.positions_m[at(ic)];
  const double longest = std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()});
  const int n = std::clamp(static_cast<int>(std::ceil(longest / step)), 1, kMostSteps);
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; i + j <= n; ++j) {
      const double u = static_cast<double>(i) / n, v = static_cast<double>(j) / n;
      visit(Vec3((1.0 - u - v) * a + u * b + v * c));
    }
  }
}

/// Input triangles that do not count: dropped on purpose, or copies of such.
std::vector<bool> triangles_left_out(const RepairJob& job) {
  std::vector<bool> left_out = job.left_out;
  for (auto copy = job.copies.rbegin(); copy != job.copies.rend(); ++copy) {
    if (copy->first >= 0 && copy->second >= 0 && left_out[at(copy->second)]) left_out[at(copy->first)] = true;
  }
  return left_out;
}

TriangleMesh in_working_coordinates(const RepairJob& job, const TriangleMesh& raw, const std::vector<bool>& left_out) {
  TriangleMesh result;
  for (const Vec3& p : raw.positions_m) {
    result.positions_m.emplace_back((p - job.frame.centre_m) / job.frame.diagonal_m);
  }
  for (std::size_t t = 0; t < raw.triangles.size(); ++t) {
    if (!left_out[t]) result.triangles.push_back(raw.triangles[t]);
  }
  return result;
}

/// Marks triangles that are in both surfaces: by index into the repaired ones and into the input's.
struct Unchanged {
  std::vector<bool> repaired, raw;
};

Unchanged find_unchanged(const RepairJob& job, const TriangleMesh& input, const TriangleMesh& raw) {
  Unchanged same{std::vector<bool>(job.face_source.size(), false), std::vector<bool>(raw.triangles.size(), false)};
  for (std::size_t t = 0; t < job.face_source.size(); ++t) {
    if (job.face_source[t] < 0) continue;
    const auto& source = raw.triangles[at(job.face_source[t])];
    const auto& triangle = job.mesh.triangles[t];
    same.repaired[t] = std::all_of(triangle.begin(), triangle.end(), [&](int v) {
      return std::any_of(source.begin(), source.end(),
                         [&](int s) { return input.positions_m[at(s)] == job.mesh.positions_m[at(v)]; });
    });
    if (same.repaired[t]) same.raw[at(job.face_source[t])] = true;
  }
  return same;
}

void widen(SurfaceMove& move, const Vec3& place, double distance) {
  if (distance > move.distance) move = {distance, place};
}

}  // namespace

SurfaceMove measure_move(const RepairJob& job, const TriangleMesh& raw) {
  const std::vector<bool> left_out = triangles_left_out(job);
  const TriangleMesh input = in_working_coordinates(job, raw, left_out);
  const TriangleMesh all{input.positions_m, raw.triangles};
  const Unchanged same = find_unchanged(job, input, raw);
  const double step = kStep * job.settings.tolerance, near = kNear * job.settings.tolerance;
  SurfaceMove move;

  const geometry::TriangleTree input_tree(input);
  for (int t = 0; t < static_cast<int>(job.face_source.size()); ++t) {
    const int source = job.face_source[at(t)];
    if (same.repaired[at(t)] || source == kFill) continue;
    const bool corners = source >= 0 && corners_near(job.mesh, t, corners_of(all, source), near);
    visit_places(job.mesh, t, corners ? kWhole : step,
                 [&](const Vec3& p) { widen(move, p, input_tree.nearest(p, input.positions_m).distance_m); });
  }

  const geometry::TriangleTree repaired_tree(job.mesh);
  const std::vector<int> image = images_of(job);
  const std::vector<bool> hidden = job.united ? points_inside(job.mesh, all.positions_m) : std::vector<bool>();
  const auto is_hidden = [&](int t) {
    const auto& [a, b, c] = all.triangles[at(t)];
    return !hidden.empty() && hidden[at(a)] && hidden[at(b)] && hidden[at(c)];
  };
  std::vector<Vec3> far;  // places to be looked at again where pieces were united
  for (int t = 0; t < static_cast<int>(raw.triangles.size()); ++t) {
    if (same.raw[at(t)] || left_out[at(t)]) continue;
    const bool corners = image[at(t)] >= 0 && corners_near(all, t, corners_of(job.mesh, image[at(t)]), near);
    visit_places(all, t,
                 corners        ? kWhole
                 : is_hidden(t) ? kHidden * step
                                : step,
                 [&](const Vec3& p) {
                   const double distance = repaired_tree.nearest(p, job.mesh.positions_m).distance_m;
                   if (job.united && distance > move.distance) {
                     far.push_back(p);
                   } else {
                     widen(move, p, distance);
                   }
                 });
  }
  const std::vector<bool> inside = far.empty() ? std::vector<bool>() : points_inside(job.mesh, far);
  for (std::size_t i = 0; i < far.size(); ++i) {
    if (i < inside.size() && inside[i]) continue;
    widen(move, far[i], repaired_tree.nearest(far[i], job.mesh.positions_m).distance_m);
  }
  return move;
}

}  // namespace myotact::prepare
