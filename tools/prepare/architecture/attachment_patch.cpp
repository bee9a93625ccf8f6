#include "prepare/architecture/attachment_patch.h"

#include <algorithm>
#include <limits>
#include <map>
#include <queue>
#include <set>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/error.h"
#include "geometry/triangle_tree.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;

/// Least share of the surface and least number of triangles: below, a flux field comes out flat in most of the muscle
/// (measured on tibialis cranialis with one vertex: 90 % of the volume).
constexpr double kLeastArea = 0.03;
constexpr std::size_t kLeastTriangles = 8;  // of an end
/// Least number of triangles of one site, where an end has several.
constexpr std::size_t kLeastTrianglesOfSite = 4;
/// Largest share: an attachment that covered more would leave no free muscle between the ends.
constexpr double kMostArea = 0.12;
/// A millimetre from the known middle counts as much as half a millimetre from the bone: bones are known surfaces,
/// middles are single markers.
constexpr double kPointWeight = 0.5;
/// A muscle that ends further from its bone than this hangs in the air [m]. Lofts end up to 15 mm short of it.
constexpr double kFarthest_m = 0.03;

double triangle_area_m2(const TriangleMesh& mesh, int t) {
  const auto& c = mesh.triangles[static_cast<std::size_t>(t)];
  const Vec3& a = mesh.positions_m[static_cast<std::size_t>(c[0])];
  return 0.5 * (mesh.positions_m[static_cast<std::size_t>(c[1])] - a)
                   .cross(mesh.positions_m[static_cast<std::size_t>(c[2])] - a)
                   .norm();
}

Vec3 triangle_centre_m(const TriangleMesh& mesh, int t) {
  const auto& c = mesh.triangles[static_cast<std::size_t>(t)];
  return (mesh.positions_m[static_cast<std::size_t>(c[0])] + mesh.positions_m[static_cast<std::size_t>(c[1])] +
          mesh.positions_m[static_cast<std::size_t>(c[2])]) /
         3.0;
}

std::vector<std::vector<int>> triangles_of_vertices(const TriangleMesh& mesh) {
  std::vector<std::vector<int>> result(mesh.positions_m.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const int v : mesh.triangles[t]) result[static_cast<std::size_t>(v)].push_back(static_cast<int>(t));
  }
  return result;
}

/// Distance to the bones plus the weighted distance to the guide point, one a vertex [m].
std::vector<double> vertex_costs_m(const TriangleMesh& surface, const PatchGuide& guide,
                                   std::vector<double>& bone_distance_m) {
  const geometry::TriangleTree tree(guide.bones);
  std::vector<double> costs_m;
  for (const Vec3& p : surface.positions_m) {
    const double to_point_m = (p - guide.point_m).norm();
    const bool on_bone = !guide.bones.triangles.empty();
    bone_distance_m.push_back(on_bone ? tree.nearest(p, guide.bones.positions_m).distance_m : to_point_m);
    costs_m.push_back(bone_distance_m.back() + kPointWeight * to_point_m);
  }
  return costs_m;
}

/// Triangles that touch a vertex of `taken`.
std::set<int> blocked_by(const TriangleMesh& surface, const std::vector<std::vector<int>>& around,
                         const std::vector<int>& taken) {
  std::set<int> blocked;
  for (const int t : taken) {
    for (const int v : surface.triangles[static_cast<std::size_t>(t)]) {
      blocked.insert(around[static_cast<std::size_t>(v)].begin(), around[static_cast<std::size_t>(v)].end());
    }
  }
  return blocked;
}

void finish(const TriangleMesh& surface, const std::vector<double>& bone_distance_m, AttachmentPatch& patch) {
  std::set<int> vertices;
  patch.centroid_m = Vec3::Zero();
  for (const int t : patch.triangles) {
    patch.centroid_m += triangle_area_m2(surface, t) / patch.area_m2 * triangle_centre_m(surface, t);
    vertices.insert(surface.triangles[static_cast<std::size_t>(t)].begin(),
                    surface.triangles[static_cast<std::size_t>(t)].end());
  }
  patch.vertices.assign(vertices.begin(), vertices.end());
  patch.bone_distance_m = std::numeric_limits<double>::infinity();
  for (const int v : patch.vertices) {
    patch.bone_distance_m = std::min(patch.bone_distance_m, bone_distance_m[static_cast<std::size_t>(v)]);
  }
}

/// What a patch must reach.
struct PatchGoal {
  double area_m2 = 0.0;
  std::size_t triangles = 0;
};

/// The triangles of a patch that grows from the cheapest free triangle, always by the cheapest neighbour. Where the
/// free surface around it is too small, its triangles join `blocked`. Fewer than the goal's: there is no room anywhere.
std::vector<int> grow(const TriangleMesh& surface, const std::vector<std::vector<int>>& around,
                      const std::vector<double>& costs_m, const PatchGoal& goal, std::set<int> blocked) {
  using Candidate = std::pair<double, int>;  // cost, triangle
  const auto candidate = [&](int t) {
    double cost_m = 0.0;
    for (const int v : surface.triangles[static_cast<std::size_t>(t)]) {
      cost_m += costs_m[static_cast<std::size_t>(v)] / 3.0;
    }
    return Candidate(cost_m, t);
  };
  while (true) {
    Candidate seed{std::numeric_limits<double>::infinity(), -1};
    for (int t = 0; t < static_cast<int>(surface.triangles.size()); ++t) {
      if (!blocked.contains(t)) seed = std::min(seed, candidate(t));
    }
    if (seed.second < 0) return {};
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> frontier;
    std::set<int> seen = blocked;
    seen.insert(seed.second);
    frontier.push(seed);
    std::vector<int> patch;
    double area_m2 = 0.0;
    while (!frontier.empty() && (area_m2 < goal.area_m2 || patch.size() < goal.triangles)) {
      const int t = frontier.top().second;
      frontier.pop();
      patch.push_back(t);
      area_m2 += triangle_area_m2(surface, t);
      for (const int v : surface.triangles[static_cast<std::size_t>(t)]) {
        for (const int next : around[static_cast<std::size_t>(v)]) {
          if (seen.insert(next).second) frontier.push(candidate(next));
        }
      }
    }
    if (patch.size() >= goal.triangles) return patch;
    blocked.insert(patch.begin(), patch.end());
  }
}

}  // namespace

AttachmentPatch grow_patch(const std::string& name, const TriangleMesh& surface, const PatchGuide& guide,
                           const std::vector<int>& taken) {
  std::vector<double> bone_distance_m;
  const std::vector<double> costs_m = vertex_costs_m(surface, guide, bone_distance_m);
  const auto around = triangles_of_vertices(surface);
  std::set<int> blocked = blocked_by(surface, around, taken);
  blocked.insert(guide.covered.begin(), guide.covered.end());
  const double whole_m2 = geometry::surface_area_m2(surface);
  const PatchGoal goal{std::clamp(guide.area_m2, kLeastArea * whole_m2, kMostArea * whole_m2) / guide.sites,
                       std::max(kLeastTriangles / static_cast<std::size_t>(guide.sites), kLeastTrianglesOfSite)};
  AttachmentPatch patch;
  patch.triangles = grow(surface, around, costs_m, goal, blocked);
  if (patch.triangles.empty() && !guide.covered.empty()) return {};
  if (patch.triangles.empty()) {
    throw bad_data(name, "attachments", "the surface has too few triangles for two attachments; ask for more tets");
  }
  for (const int t : patch.triangles) patch.area_m2 += triangle_area_m2(surface, t);
  finish(surface, bone_distance_m, patch);
  if (patch.bone_distance_m > kFarthest_m) {
    throw bad_data(
        name, "attachments",
        fmt::format("the muscle ends {:.1f} mm from its bone; must be at most {:.0f} mm. Check the bones and "
                    "the attachment point of the muscle in the recipe",
                    1e3 * patch.bone_distance_m, 1e3 * kFarthest_m));
  }
  return patch;
}

}  // namespace myotact::prepare
