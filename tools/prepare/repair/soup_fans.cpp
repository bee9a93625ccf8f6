#include <algorithm>
#include <map>
#include <set>

#include <Eigen/Geometry>

#include "prepare/repair/fan_pull.h"
#include "prepare/repair/soup.h"
#include "prepare/surface/edge_table.h"
#include "prepare/surface/edge_wheel.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;

/// Fans that met in one vertex are pulled this far apart [diagonals], a hundredth of a millimetre on a muscle.
constexpr double kPull = 1e-4;

/// An edge with more than two triangles.
struct CrowdedEdge {
  int low = 0, high = 0;
  std::vector<SpokeTriangle> wheel;
};

std::vector<CrowdedEdge> crowded_edges(const TriangleMesh& mesh) {
  std::vector<CrowdedEdge> edges;
  EdgeTable(mesh).for_each_edge([&](int low, int high, std::span<const EdgeUse> uses) {
    if (uses.size() > 2) edges.push_back({low, high, wheel_around(mesh, low, high, uses)});
  });
  return edges;
}

/// Joins the corners of triangles that are neighbours around a vertex, and marks corners with an open edge. At a
/// crowded edge triangles are neighbours that have the inside between them: bodies that touch there come apart. Where
/// `joined` says so of its lower vertex, those with the outside between them: the body is one there.
class Fans {
 public:
  Fans(const TriangleMesh& mesh, const std::vector<CrowdedEdge>& crowded, const std::vector<bool>& joined)
      : mesh_(mesh), corners_(3 * mesh.triangles.size()), open_(corner_count()) {
    EdgeTable(mesh).for_each_edge([&](int, int, std::span<const EdgeUse> uses) {
      if (uses.size() == 2) return join(uses[0].side, uses[1].side);
      if (uses.size() == 1) return mark_open(uses[0].side);
    });
    for (const CrowdedEdge& edge : crowded) join_wedges(edge.wheel, joined[at(edge.low)]);
  }

  int fan_of(int corner) { return corners_.group_of(corner); }

  /// Whether all triangles at the edge that start, or end, at one of its vertices are of one fan there.
  bool is_one_fan(const CrowdedEdge& edge, bool at_low) {
    const auto corner = [&](const SpokeTriangle& spoke) {
      return spoke.forward == at_low ? spoke.side : next_corner(spoke.side);
    };
    const int first = fan_of(corner(edge.wheel.front()));
    return std::all_of(edge.wheel.begin(), edge.wheel.end(),
                       [&](const SpokeTriangle& spoke) { return fan_of(corner(spoke)) == first; });
  }

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

  /// A backward triangle has the inside between it and the forward one after it; the outside lies before it.
  void join_wedges(const std::vector<SpokeTriangle>& wheel, bool joined) {
    for (std::size_t i = 0; i < wheel.size(); ++i) {
      const SpokeTriangle& next = wheel[(i + 1) % wheel.size()];
      const SpokeTriangle& before = wheel[(i + wheel.size() - 1) % wheel.size()];
      const bool first = wheel[i].forward == joined;  // of a pair; the other one of it comes after
      if (first && next.forward != joined) join(wheel[i].side, next.side);
      const bool alone = first ? next.forward == joined : before.forward != joined;
      if (alone) mark_open(wheel[i].side);
    }
  }

  const TriangleMesh& mesh_;
  Groups corners_;
  std::vector<bool> open_;
};

/// Where a body that touches itself along edges holds together at both ends of their chain, coming apart would leave a
/// tunnel of no width, or, along a single edge, would not even be possible: there it is joined. One a vertex.
std::vector<bool> where_bodies_join(const TriangleMesh& mesh, const std::vector<CrowdedEdge>& crowded) {
  std::vector<bool> joined(mesh.positions_m.size(), false);
  Fans apart(mesh, crowded, joined);
  Groups chains(mesh.positions_m.size());
  std::map<int, std::set<int>> held_at;  // chain -> vertices
  for (const CrowdedEdge& edge : crowded) chains.join(edge.low, edge.high);
  for (const CrowdedEdge& edge : crowded) {
    if (apart.is_one_fan(edge, true)) held_at[chains.group_of(edge.low)].insert(edge.low);
    if (apart.is_one_fan(edge, false)) held_at[chains.group_of(edge.low)].insert(edge.high);
  }
  for (const CrowdedEdge& edge : crowded) {
    const auto held = held_at.find(chains.group_of(edge.low));
    if (held == held_at.end() || held->second.size() < 2) continue;
    joined[at(edge.low)] = joined[at(edge.high)] = true;
  }
  return joined;
}

}  // namespace

void split_shared_vertices(RepairJob& job) {
  const std::vector<CrowdedEdge> crowded = crowded_edges(job.mesh);
  const auto shared = Fans(job.mesh, crowded, where_bodies_join(job.mesh, crowded)).shared_vertices();
  const TriangleMesh before = job.mesh;
  int split = 0;
  Vec3 place = Vec3::Zero();
  for (std::size_t v = 0; v < shared.size(); ++v) {
    if (shared[v].empty()) continue;
    if (split++ == 0) place = before.positions_m[v];
    const std::vector<Vec3> places = pulled_apart(before, shared[v], kPull);
    for (std::size_t fan = 0; fan < shared[v].size(); ++fan) {
      if (places[fan] == before.positions_m[v]) continue;
      const int copy = static_cast<int>(job.mesh.positions_m.size());
      job.mesh.positions_m.push_back(places[fan]);
      job.vertex_source.push_back(-1);
      for (const int c : shared[v][fan]) job.mesh.triangles[at(c / 3)][at(c % 3)] = copy;
    }
  }
  note(job, "vertices shared by several fans split", split, place);
}

}  // namespace myotact::prepare
