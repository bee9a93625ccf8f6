#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "geometry/triangle_tree.h"
#include "prepare/repair/soup.h"
#include "prepare/surface/edge_table.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;

/// How far seams are searched [diagonals], one after the other: rounding of text and floats, then gaps of a scan of
/// 0.01 to 0.1 mm on a body of 100 mm.
constexpr std::array<double, 3> kSeamReach = {1e-6, 1e-5, 1e-4};
/// An edge that takes vertices on two sides is split again; three sides, then what the splits opened.
constexpr int kSplitRounds = 6;

/// Points are sorted along this direction, which no grid or flat end is perpendicular to.
const Vec3 kSkew = Vec3(0.57143191, 0.21390287, 0.79228737).normalized();

/// For each vertex the one to take instead: the lowest within `reach` of the first in its neighbourhood.
std::vector<int> weld_targets(const TriangleMesh& mesh, const std::vector<bool>& may, double reach) {
  std::vector<int> order;
  std::vector<double> key(mesh.positions_m.size());
  for (std::size_t v = 0; v < key.size(); ++v) {
    key[v] = kSkew.dot(mesh.positions_m[v]);
    if (may[v]) order.push_back(static_cast<int>(v));
  }
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return key[at(a)] != key[at(b)] ? key[at(a)] < key[at(b)] : a < b; });
  std::vector<int> target(key.size());
  std::iota(target.begin(), target.end(), 0);
  std::vector<bool> taken(key.size(), false);
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (taken[at(order[i])]) continue;
    std::vector<int> group{order[i]};
    for (std::size_t j = i + 1; j < order.size() && key[at(order[j])] <= key[at(order[i])] + reach; ++j) {
      if (taken[at(order[j])]) continue;
      if ((mesh.positions_m[at(order[j])] - mesh.positions_m[at(order[i])]).norm() > reach) continue;
      taken[at(order[j])] = true;
      group.push_back(order[j]);
    }
    const int lowest = *std::min_element(group.begin(), group.end());
    for (const int v : group) target[at(v)] = lowest;
  }
  return target;
}

/// Number of vertices joined.
int weld(RepairJob& job, const std::vector<bool>& may, double reach, Vec3& place) {
  const std::vector<int> target = weld_targets(job.mesh, may, reach);
  int welded = 0;
  for (std::size_t v = 0; v < target.size(); ++v) {
    if (target[v] == static_cast<int>(v)) continue;
    if (welded++ == 0) place = job.mesh.positions_m[v];
  }
  if (welded == 0) return 0;
  std::vector<bool> keep;
  for (auto& triangle : job.mesh.triangles) {
    for (int& v : triangle) v = target[at(v)];
    const auto& [a, b, c] = triangle;
    keep.push_back(a != b && b != c && c != a);
  }
  keep_triangles(job, keep, Dropped::StillCovered);
  return welded;
}

std::vector<bool> on_open_edge(const TriangleMesh& mesh) {
  std::vector<bool> open(mesh.positions_m.size(), false);
  EdgeTable(mesh).for_each_edge([&](int low, int high, std::span<const EdgeUse> uses) {
    if (uses.size() == 1) open[at(low)] = open[at(high)] = true;
  });
  return open;
}

/// A side and the vertices on it, in its direction.
struct SplitSide {
  int side;
  std::vector<int> vertices;
};

/// Parameter of the place on the side nearest to the vertex, when it lies within reach and clear of both ends.
std::optional<double> place_on_side(const TriangleMesh& mesh, int side, int vertex, double reach) {
  const Vec3& from = mesh.positions_m[at(tail_of(mesh, side))];
  const Vec3 along = mesh.positions_m[at(head_of(mesh, side))] - from;
  const Vec3 offset = mesh.positions_m[at(vertex)] - from;
  const double s = offset.dot(along) / along.squaredNorm();
  const double margin = reach / along.norm();
  if (s <= margin || s >= 1.0 - margin || (offset - s * along).norm() > reach) return std::nullopt;
  return s;
}

/// The sides between vertices of open edges that another such vertex lies on; at most one side of a triangle. Most are
/// open, but a fin on one lip of a seam makes that lip look closed.
std::vector<SplitSide> sides_to_split(const TriangleMesh& mesh, double reach) {
  TriangleMesh edges{mesh.positions_m, {}};
  std::vector<int> side_of;
  const std::vector<bool> open = on_open_edge(mesh);
  EdgeTable(mesh).for_each_edge([&](int low, int high, std::span<const EdgeUse> uses) {
    if (!open[at(low)] || !open[at(high)]) return;
    for (const EdgeUse& use : uses) {
      edges.triangles.push_back({low, high, high});
      side_of.push_back(use.side);
    }
  });
  const geometry::TriangleTree tree(edges);
  std::vector<std::vector<std::pair<double, int>>> found(side_of.size());
  for (int v = 0; v < static_cast<int>(open.size()); ++v) {
    if (!open[at(v)]) continue;
    tree.visit_within(mesh.positions_m[at(v)], reach, [&](int e) {
      const auto& triangle = mesh.triangles[at(side_of[at(e)] / 3)];
      const bool own = std::find(triangle.begin(), triangle.end(), v) != triangle.end();
      const auto s = own ? std::nullopt : place_on_side(mesh, side_of[at(e)], v, reach);
      if (s) found[at(e)].emplace_back(*s, v);
      return reach;
    });
  }
  std::vector<bool> used(mesh.triangles.size(), false);
  std::vector<SplitSide> result;
  for (std::size_t e = 0; e < found.size(); ++e) {
    if (found[e].empty() || used[at(side_of[e] / 3)]) continue;
    used[at(side_of[e] / 3)] = true;
    std::sort(found[e].begin(), found[e].end());
    SplitSide split{side_of[e], {}};
    for (const auto& [s, v] : found[e]) split.vertices.push_back(v);
    result.push_back(std::move(split));
  }
  return result;
}

/// Splits the triangle of the side into a row from the opposite corner.
void split_side(RepairJob& job, const SplitSide& split) {
  const int triangle = split.side / 3;
  const int source = job.face_source[at(triangle)];
  const int end = head_of(job.mesh, split.side);
  const int apex = head_of(job.mesh, next_corner(split.side));
  int from = tail_of(job.mesh, split.side);
  job.mesh.triangles[at(triangle)] = {from, split.vertices.front(), apex};
  for (std::size_t i = 0; i < split.vertices.size(); ++i) {
    from = split.vertices[i];
    add_triangle(job, {from, i + 1 < split.vertices.size() ? split.vertices[i + 1] : end, apex}, source);
  }
}

int split_open_edges(RepairJob& job, double reach, Vec3& place) {
  int count = 0;
  for (int round = 0; round < kSplitRounds; ++round) {
    const std::vector<SplitSide> splits = sides_to_split(job.mesh, reach);
    if (splits.empty()) break;
    for (const SplitSide& split : splits) {
      if (count == 0) place = job.mesh.positions_m[at(split.vertices.front())];
      count += static_cast<int>(split.vertices.size());
      split_side(job, split);
    }
  }
  return count;
}

}  // namespace

void check_input(const std::string& name, const TriangleMesh& raw) {
  if (raw.triangles.empty()) throw bad_data(name, "", "is empty: it has no triangles; export the surface again");
  const int vertices = static_cast<int>(raw.positions_m.size());
  for (std::size_t t = 0; t < raw.triangles.size(); ++t) {
    for (const int v : raw.triangles[t]) {
      if (v >= 0 && v < vertices) continue;
      throw bad_data(name, fmt::format("triangle {}", t),
                     fmt::format("names vertex {}; must be 0 .. {}. Export the surface again", v, vertices - 1));
    }
  }
  for (std::size_t v = 0; v < raw.positions_m.size(); ++v) {
    if (raw.positions_m[v].allFinite()) continue;
    throw bad_data(name, fmt::format("vertex {}", v), "is not finite; export the surface again");
  }
}

void weld_equal_vertices(RepairJob& job) {
  std::vector<bool> used(job.mesh.positions_m.size(), false);
  for (const auto& [a, b, c] : job.mesh.triangles) used[at(a)] = used[at(b)] = used[at(c)] = true;
  const auto unused = std::find(used.begin(), used.end(), false);
  Vec3 place =
      unused == used.end() ? Vec3::Zero() : job.mesh.positions_m[static_cast<std::size_t>(unused - used.begin())];
  note(job, "unused vertices dropped", static_cast<int>(std::count(used.begin(), used.end(), false)), place);
  drop_unused_vertices(job);
  const int welded = weld(job, std::vector<bool>(job.mesh.positions_m.size(), true), kSame, place);
  note(job, "equal vertices welded", welded, place);
  std::vector<bool> keep;
  int repeated = 0;
  for (const auto& [a, b, c] : job.mesh.triangles) {
    keep.push_back(a != b && b != c && c != a);
    repeated += keep.back() ? 0 : 1;
    if (!keep.back()) place = job.mesh.positions_m[at(a)];
  }
  keep_triangles(job, keep, Dropped::StillCovered);
  note(job, "triangles without three corners dropped", repeated, place);
}

void close_seams(RepairJob& job) {
  for (const double reach : kSeamReach) {
    const EdgeCounts before = count_edges(job.mesh);
    if (before.open == 0) return;
    RepairJob trial = job;
    Vec3 place = Vec3::Zero();
    note(trial, "vertices of open seams welded", weld(trial, on_open_edge(trial.mesh), reach, place), place);
    note(trial, "edges split at vertices on them", split_open_edges(trial, reach, place), place);
    drop_flat_triangles(trial);
    drop_copies(trial);
    const EdgeCounts after = count_edges(trial.mesh);
    const bool better = after.open < before.open || after.open_length < (1.0 - kSame) * before.open_length;
    const bool crowds = after.crowded - before.crowded > std::max(0, before.open - after.open);
    if (better && !crowds && !trial.mesh.triangles.empty()) job = std::move(trial);
  }
}

}  // namespace myotact::prepare
