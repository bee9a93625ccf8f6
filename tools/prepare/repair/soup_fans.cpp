#include <algorithm>
#include <set>

#include <Eigen/Geometry>

#include "prepare/repair/soup.h"
#include "prepare/surface/edge_table.h"
#include "prepare/surface/edge_wheel.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;

/// Fans that met in one vertex are pulled this far apart [diagonals], a hundredth of a millimetre on a muscle, but no
/// farther than this part of their shortest edge.
constexpr double kPull = 1e-4;
constexpr double kPullOfEdge = 0.1;

/// Joins the corners of triangles that are neighbours around a vertex, and marks corners with an open edge.
class Fans {
 public:
  explicit Fans(const TriangleMesh& mesh) : mesh_(mesh), corners_(3 * mesh.triangles.size()), open_(corner_count()) {
    EdgeTable(mesh).for_each_edge([&](int low, int high, std::span<const EdgeUse> uses) {
      if (uses.size() == 2) return join(uses[0].side, uses[1].side);
      if (uses.size() == 1) return mark_open(uses[0].side);
      join_wedges(wheel_around(mesh_, low, high, uses));
    });
  }

  int fan_of(int corner) { return corners_.group_of(corner); }

  /// The fans around each vertex of which some, but not all alike, must part: groups of corners by vertex. All fans
  /// with open edges count as one.
  std::vector<std::vector<std::vector<int>>> shared_vertices() {
    std::vector<bool> open_fan(corner_count(), false);
    for (std::size_t c = 0; c < corner_count(); ++c) {
      if (open_[c]) open_fan[at(fan_of(static_cast<int>(c)))] = true;
    }
    std::vector<std::vector<int>> fans_at(mesh_.positions_m.size());  // names; -1 for the open ones
    const auto name_of = [&](int corner) { return open_fan[at(fan_of(corner))] ? -1 : fan_of(corner); };
    for (int c = 0; c < static_cast<int>(corner_count()); ++c) {
      std::vector<int>& names = fans_at[at(tail_of(mesh_, c))];
      if (std::find(names.begin(), names.end(), name_of(c)) == names.end()) names.push_back(name_of(c));
    }
    std::vector<std::vector<std::vector<int>>> result(mesh_.positions_m.size());
    for (int c = 0; c < static_cast<int>(corner_count()); ++c) {
      const auto v = at(tail_of(mesh_, c));
      if (fans_at[v].size() < 2) continue;
      result[v].resize(fans_at[v].size());
      const auto which = std::find(fans_at[v].begin(), fans_at[v].end(), name_of(c)) - fans_at[v].begin();
      result[v][static_cast<std::size_t>(which)].push_back(c);
    }
    return result;
  }

 private:
  std::size_t corner_count() const { return 3 * mesh_.triangles.size(); }

  /// The corners of two sides along one edge, at both of its ends.
  void join(int side, int other) {
    const bool against = tail_of(mesh_, side) == head_of(mesh_, other);
    corners_.join(side, against ? next_corner(other) : other);
    corners_.join(next_corner(side), against ? other : next_corner(other));
  }

  void mark_open(int side) { open_[at(side)] = open_[at(next_corner(side))] = true; }

  /// Triangles with the inside between them belong to one body: a backward one and the forward one after it.
  void join_wedges(const std::vector<SpokeTriangle>& wheel) {
    for (std::size_t i = 0; i < wheel.size(); ++i) {
      const SpokeTriangle& next = wheel[(i + 1) % wheel.size()];
      const SpokeTriangle& before = wheel[(i + wheel.size() - 1) % wheel.size()];
      if (!wheel[i].forward && next.forward) join(wheel[i].side, next.side);
      const bool alone = wheel[i].forward ? before.forward : !next.forward;
      if (alone) mark_open(wheel[i].side);
    }
  }

  const TriangleMesh& mesh_;
  Groups corners_;
  std::vector<bool> open_;
};

/// The vertex of the fan, moved a little towards the middle of its rim.
Vec3 pulled(const TriangleMesh& mesh, const std::vector<int>& corners) {
  const Vec3 p = mesh.positions_m[at(tail_of(mesh, corners.front()))];
  std::set<int> rim;
  for (const int c : corners) {
    rim.insert(head_of(mesh, c));
    rim.insert(head_of(mesh, next_corner(c)));
  }
  Vec3 middle = Vec3::Zero();
  double shortest = 1.0;
  for (const int v : rim) {
    const Vec3 spoke = mesh.positions_m[at(v)] - p;
    middle += spoke / static_cast<double>(rim.size());
    shortest = std::min(shortest, spoke.norm());
  }
  return p + std::min(kPull, kPullOfEdge * shortest) * middle.normalized();
}

}  // namespace

void split_shared_vertices(RepairJob& job) {
  const auto shared = Fans(job.mesh).shared_vertices();
  const TriangleMesh before = job.mesh;
  int split = 0;
  Vec3 place = Vec3::Zero();
  for (std::size_t v = 0; v < shared.size(); ++v) {
    if (shared[v].empty()) continue;
    if (split++ == 0) place = before.positions_m[v];
    for (std::size_t fan = 1; fan < shared[v].size(); ++fan) {
      const int copy = static_cast<int>(job.mesh.positions_m.size());
      job.mesh.positions_m.push_back(pulled(before, shared[v][fan]));
      job.vertex_source.push_back(-1);
      for (const int c : shared[v][fan]) job.mesh.triangles[at(c / 3)][at(c % 3)] = copy;
    }
  }
  note(job, "vertices shared by several fans split", split, place);
}

}  // namespace myotact::prepare
