#include "prepare/repair/surface_check.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "prepare/remesh/crossing_triangles.h"
#include "prepare/repair/repair_job.h"
#include "prepare/surface/edge_table.h"
#include "prepare/surface/surface_pieces.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;
using Defect = std::optional<SurfaceDefect>;

/// Largest and smallest diagonal of a bone or muscle of a dog, down to its sesamoid bones [m]. Outside, the file is not
/// in metres.
constexpr double kSmallest_m = 3e-3;
constexpr double kLargest_m = 1.5;
/// A triangle whose height is below this part of the diagonal has none: rounding of its corners.
constexpr double kFlat = 1e-12;
/// Crossings are counted up to here.
constexpr unsigned kMostPairs = 10000;

double diagonal_m(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : mesh.positions_m) box.extend(p);
  return box.diagonal().norm();
}

Defect find_bad_triangle(const TriangleMesh& mesh) {
  std::vector<bool> used(mesh.positions_m.size(), false);
  const double least_m = kFlat * diagonal_m(mesh);
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const auto& [a, b, c] = mesh.triangles[at(t)];
    if (a == b || b == c || c == a || !(least_height(mesh, t) > least_m)) {
      return SurfaceDefect{fmt::format("triangle {} has no area", t), centroid(mesh, t)};
    }
    used[at(a)] = used[at(b)] = used[at(c)] = true;
  }
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) return SurfaceDefect{fmt::format("no triangle uses vertex {}", v), mesh.positions_m[v]};
  }
  return std::nullopt;
}

Defect find_bad_edge(const TriangleMesh& mesh, const std::vector<int>& opposite) {
  int open = 0, crowded = 0, unlike = 0;
  Vec3 place_m = Vec3::Zero();
  for (int side = 0; side < static_cast<int>(opposite.size()); ++side) {
    const int other = opposite[at(side)];
    const bool differs = other >= 0 && tail_of(mesh, side) != head_of(mesh, other);
    if (other >= 0 && !differs) continue;
    if (open + crowded + unlike == 0) {
      place_m = 0.5 * (mesh.positions_m[at(tail_of(mesh, side))] + mesh.positions_m[at(head_of(mesh, side))]);
    }
    ++(other == kOpen ? open : other == kCrowded ? crowded : unlike);
  }
  if (open + crowded + unlike == 0) return std::nullopt;
  return SurfaceDefect{fmt::format("is not closed: {} sides of triangles are open, {} meet more than one other, {} are "
                                   "wound against their neighbours; each must be 0",
                                   open, crowded, unlike),
                       place_m};
}

/// Goes round each vertex once; corners left over belong to a second fan. Closed mesh.
Defect find_shared_vertex(const TriangleMesh& mesh, const std::vector<int>& opposite) {
  std::vector<bool> met(opposite.size(), false), reached(mesh.positions_m.size(), false);
  for (int corner = 0; corner < static_cast<int>(opposite.size()); ++corner) {
    if (met[at(corner)]) continue;
    const auto v = at(tail_of(mesh, corner));
    if (reached[v]) {
      return SurfaceDefect{fmt::format("vertex {} joins more than one fan of triangles", v), mesh.positions_m[v]};
    }
    reached[v] = true;
    for (int c = corner; !met[at(c)]; c = next_corner(opposite[at(c)])) met[at(c)] = true;
  }
  return std::nullopt;
}

Defect find_inward_piece(const TriangleMesh& mesh) {
  const std::vector<int> piece = piece_of_triangles(mesh);
  std::vector<double> six_volumes;
  std::vector<Vec3> origin;
  for (int t = 0; t < static_cast<int>(piece.size()); ++t) {
    const Vec3& corner = mesh.positions_m[at(mesh.triangles[at(t)][0])];
    if (at(piece[at(t)]) == six_volumes.size()) {
      six_volumes.push_back(0.0);
      origin.push_back(corner);
    }
    six_volumes[at(piece[at(t)])] += (corner - origin[at(piece[at(t)])]).dot(area_vector(mesh, t));
  }
  for (std::size_t p = 0; p < origin.size(); ++p) {
    if (six_volumes[p] > 0.0) continue;
    return SurfaceDefect{fmt::format("encloses {} m3; must be above 0", to_text(six_volumes[p] / 6.0)), origin[p]};
  }
  return std::nullopt;
}

Defect find_crossing(const TriangleMesh& mesh) {
  const auto pairs = crossing_triangles(mesh, kMostPairs);
  if (pairs.empty()) return std::nullopt;
  return SurfaceDefect{fmt::format("crosses itself: {} pairs of triangles cross each other; must be 0", pairs.size()),
                       centroid(mesh, pairs.front().first)};
}

}  // namespace

void check_size(const std::string& name, const TriangleMesh& mesh) {
  const double size_m = mesh.positions_m.empty() ? 0.0 : diagonal_m(mesh);
  if (!(size_m < kSmallest_m) && !(size_m > kLargest_m)) return;
  throw bad_data(name, "size",
                 fmt::format("diagonal is {} m; must be {} .. {} m. Export the surface in metres", to_text(size_m),
                             to_text(kSmallest_m), to_text(kLargest_m)));
}

Defect find_defect(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return SurfaceDefect{"has no triangles", Vec3::Zero()};
  if (Defect defect = find_bad_triangle(mesh)) return defect;
  {
    const std::vector<int> opposite = opposite_sides(mesh);
    if (Defect defect = find_bad_edge(mesh, opposite)) return defect;
    if (Defect defect = find_shared_vertex(mesh, opposite)) return defect;
  }
  if (Defect defect = find_inward_piece(mesh)) return defect;
  return find_crossing(mesh);
}

}  // namespace myotact::prepare
