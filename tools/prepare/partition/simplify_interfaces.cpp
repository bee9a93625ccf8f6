#include "prepare/partition/simplify_interfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <queue>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <boost/container/small_vector.hpp>

#include "core/at.h"
#include "prepare/parallel.h"
#include "prepare/partition/interface_slabs.h"
#include "prepare/partition/meetings.h"
#include "prepare/partition/squared_distances.h"
#include "prepare/remesh/guarded_mesh.h"

namespace myotact::prepare {

namespace {

/// No triangle may turn by more than about 75 degrees in one collapse, nor become flatter than this shape (1:
/// equilateral) unless it was.
constexpr double kLeastCosine = 0.25, kLeastShape = 0.08;
/// Lines where three parts meet hold their place this much more than surfaces.
constexpr double kLineWeight = 2.0;

struct Collapse {
  double cost;
  int from, to;
  std::uint32_t stamp;  // of both ends' changes when it was looked at
  bool operator<(const Collapse& other) const {
    if (cost != other.cost) return cost > other.cost;
    return from != other.from ? from > other.from : to > other.to;
  }
};

class Simplifier {
 public:
  Simplifier(const Interfaces& interfaces, const SimplifySettings& settings)
      : mesh_(interfaces),
        settings_(settings),
        faces_at_(mesh_.positions_m.size()),
        stamp_(mesh_.positions_m.size(), 0),
        frozen_(mesh_.positions_m.size(), false),
        alive_(mesh_.faces.size(), true),
        distances_(mesh_.positions_m.size()),
        meeting_(mesh_.positions_m.size()) {
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      for (const int v : mesh_.faces[f].vertices) faces_at_[at(v)].push_back(static_cast<int>(f));
    }
    for (std::size_t v = 0; v < meeting_.size(); ++v) meeting_[v] = labels_of(faces_at_[v]);
    weigh();
  }

  void freeze(const NearPlaces& places) {
    for (std::size_t v = 0; v < frozen_.size(); ++v) {
      frozen_[v] = frozen_[v] || places.contain(mesh_.positions_m[v]);
    }
  }

  void freeze(const std::vector<bool>& vertices) {
    for (std::size_t v = 0; v < frozen_.size(); ++v) frozen_[v] = frozen_[v] || vertices[v];
  }

  void run() {
    for (std::size_t v = 0; v < faces_at_.size(); ++v) offer_all(static_cast<int>(v), true);
    while (!queue_.empty()) {
      const Collapse next = queue_.top();
      queue_.pop();
      if (next.stamp != stamp_[at(next.from)] + stamp_[at(next.to)]) continue;
      if (try_collapse(next.from, next.to)) offer_all(next.to, false);
    }
  }

  /// The vertices that are left, in the order of take().
  std::vector<int> kept_vertices() const {
    std::vector<int> kept;
    std::vector<bool> seen(mesh_.positions_m.size(), false);
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      if (!alive_[f]) continue;
      for (const int v : mesh_.faces[f].vertices) {
        if (!seen[at(v)]) kept.push_back(v);
        seen[at(v)] = true;
      }
    }
    return kept;
  }

  Interfaces take() const {
    Interfaces result;
    std::vector<int> number(mesh_.positions_m.size(), -1);
    for (const int v : kept_vertices()) {
      number[at(v)] = static_cast<int>(result.positions_m.size());
      result.positions_m.push_back(mesh_.positions_m[at(v)]);
    }
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      if (!alive_[f]) continue;
      Interfaces::Face face = mesh_.faces[f];
      for (int& v : face.vertices) v = number[at(v)];
      result.faces.push_back(face);
    }
    return result;
  }

 private:
  std::array<Vec3, 3> corners(int f) const {
    const auto& v = mesh_.faces[at(f)].vertices;
    return {mesh_.positions_m[at(v[0])], mesh_.positions_m[at(v[1])], mesh_.positions_m[at(v[2])]};
  }

  bool is_frozen(int v) const { return frozen_[static_cast<std::size_t>(v)]; }

  static bool has(const Interfaces::Face& face, int vertex) {
    return face.vertices[0] == vertex || face.vertices[1] == vertex || face.vertices[2] == vertex;
  }

  template <class Faces>
  Meeting labels_of(const Faces& faces) const {
    return prepare::labels_of(mesh_, faces);
  }

  Indices faces_at_edge(int a, int b) const { return faces_with(mesh_, faces_at_[at(a)], b); }

  Indices neighbours(int vertex) const { return neighbours_of(mesh_, faces_at_[at(vertex)], vertex); }

  /// Every vertex stands for the planes of its triangles, and for the planes across them along lines of three parts.
  void weigh() {
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      const auto [a, b, c] = corners(static_cast<int>(f));
      const Vec3 area = 0.5 * (b - a).cross(c - a);
      const double size = area.norm();
      if (size <= 0.0) continue;
      for (const int v : mesh_.faces[f].vertices) distances_[at(v)].add_plane(a, area / size, size / 3.0);
      for (std::size_t k = 0; k < 3; ++k) {
        weigh_line(mesh_.faces[f].vertices[k], mesh_.faces[f].vertices[(k + 1) % 3], area / size);
      }
    }
  }

  void weigh_line(int a, int b, const Vec3& normal) {
    if (meeting_[at(a)].size() < 3 || meeting_[at(b)].size() < 3) return;
    if (labels_of(faces_at_edge(a, b)).size() < 3) return;
    const Vec3 along = mesh_.positions_m[at(b)] - mesh_.positions_m[at(a)];
    const Vec3 across = along.cross(normal);
    if (across.norm() <= 0.0) return;
    for (const int v : {a, b}) {
      distances_[at(v)].add_plane(mesh_.positions_m[at(a)], across.normalized(),
                                  kLineWeight * along.squaredNorm() / 6.0);
    }
  }

  /// Whether `from` may go into `to`: it lies on nothing that the edge between them does not lie on.
  bool may_go(int from, int to, const Meeting& edge) const {
    return !is_frozen(from) && !is_frozen(to) && meeting_[at(from)].size() <= 3 && meeting_[at(from)] == edge;
  }

  /// Where both ends come to lie, when they are of the same kind; else the one that is more stays.
  Vec3 place_between(int from, int to, const SquaredDistances& both) const {
    const Vec3 &p = mesh_.positions_m[at(from)], &q = mesh_.positions_m[at(to)];
    return both.nearest_place(0.5 * (p + q), (p - q).norm());
  }

  double least_tolerance_m(const Meeting& meeting) const {
    double least_m = std::numeric_limits<double>::infinity();
    for (const std::uint16_t label : meeting) {
      if (label > 0) least_m = std::min(least_m, settings_.tolerances_m[label - std::size_t{1}]);
    }
    return least_m;
  }

  void offer_all(int vertex, bool rising_only) {
    for (const int other : neighbours(vertex)) {
      if (rising_only && other < vertex) continue;
      const Meeting edge = labels_of(faces_at_edge(vertex, other));
      const bool alike = meeting_[at(vertex)] == edge && meeting_[at(other)] == edge;  // both ways end in one place
      offer(vertex, other, edge);
      if (!alike) offer(other, vertex, edge);
    }
  }

  void offer(int from, int to, const Meeting& edge) {
    if (!may_go(from, to, edge)) return;
    SquaredDistances both = distances_[at(from)];
    both.add(distances_[at(to)]);
    const Vec3 place_m = meeting_[at(to)] == edge ? place_between(from, to, both) : mesh_.positions_m[at(to)];
    const double cost = both.mean_at(place_m);
    const double tolerance_m = least_tolerance_m(meeting_[at(from)]);
    if (cost > tolerance_m * tolerance_m) return;
    queue_.push({cost, from, to, stamp_[at(from)] + stamp_[at(to)]});
  }

  bool try_collapse(int from, int to) {
    const Indices between = faces_at_edge(from, to);
    const Meeting edge = labels_of(between);
    if (between.empty() || !may_go(from, to, edge)) return false;
    if (!links_agree(from, to, between, edge)) return false;
    SquaredDistances both = distances_[at(from)];
    both.add(distances_[at(to)]);
    const Vec3 place_m = meeting_[at(to)] == edge ? place_between(from, to, both) : mesh_.positions_m[at(to)];
    if (!faces_stay_fair(from, to, place_m) || !faces_stay_fair(to, from, place_m)) return false;
    collapse(from, to, between, place_m);
    return true;
  }

  /// Vertices beside both ends are those across the edge, no others; nor is there another way round along a line.
  bool links_agree(int from, int to, const Indices& between, const Meeting& edge) const {
    const Indices a = neighbours(from), b = neighbours(to);
    Indices common;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
    if (common.size() != between.size()) return false;
    for (const int v : common) {
      // Two triangles on each other would be left.
      if (faces_at_edge(from, v).size() + faces_at_edge(to, v).size() <= 3) return false;
      if (edge.size() < 3) continue;
      if (labels_of(faces_at_edge(from, v)).size() >= 3 && labels_of(faces_at_edge(to, v)).size() >= 3) return false;
    }
    return true;
  }

  bool faces_stay_fair(int moved, int other, const Vec3& place_m) const {
    for (const int f : faces_at_[at(moved)]) {
      const Interfaces::Face& face = mesh_.faces[at(f)];
      if (has(face, other)) continue;
      const std::array<Vec3, 3> before = corners(f);
      std::array<Vec3, 3> after = before;
      for (std::size_t k = 0; k < 3; ++k) {
        if (face.vertices[k] == moved) after[k] = place_m;
        const double edge_m = (after[k] - after[(k + 1) % 3]).norm();
        if (edge_m > settings_.longest_edge_m && edge_m > (before[k] - before[(k + 1) % 3]).norm()) return false;
      }
      const Vec3 was = (before[1] - before[0]).cross(before[2] - before[0]);
      const Vec3 is = (after[1] - after[0]).cross(after[2] - after[0]);
      const double least = std::min(kLeastShape, shape_of(before));
      if (shape_of(after) < least) return false;
      if (was.norm() > 0.0 && is.dot(was) < kLeastCosine * is.norm() * was.norm()) return false;
    }
    return true;
  }

  void collapse(int from, int to, const Indices& between, const Vec3& place_m) {
    for (const int f : between) {
      alive_[static_cast<std::size_t>(f)] = false;
      for (const int v : mesh_.faces[at(f)].vertices) {
        auto& faces = faces_at_[at(v)];
        faces.erase(std::find(faces.begin(), faces.end(), f));
      }
    }
    for (const int f : faces_at_[at(from)]) {
      for (int& v : mesh_.faces[at(f)].vertices) {
        if (v == from) v = to;
      }
      faces_at_[at(to)].push_back(f);
    }
    faces_at_[at(from)].clear();
    mesh_.positions_m[at(to)] = place_m;
    distances_[at(to)].add(distances_[at(from)]);
    ++stamp_[at(from)];
    ++stamp_[at(to)];
  }

  Interfaces mesh_;
  SimplifySettings settings_;
  std::vector<boost::container::small_vector<int, 8>> faces_at_;
  std::vector<std::uint32_t> stamp_;
  std::vector<bool> frozen_, alive_;
  std::vector<SquaredDistances> distances_;
  std::vector<Meeting> meeting_;
  std::priority_queue<Collapse> queue_;
};

void simplify_slab(Slab& slab, const SimplifySettings& settings, const NearPlaces& kept) {
  Simplifier simplifier(slab.interfaces, settings);
  simplifier.freeze(kept);
  simplifier.freeze(slab.is_shared);
  simplifier.run();
  const std::vector<int> left = simplifier.kept_vertices();
  slab.interfaces = simplifier.take();
  std::vector<int> whole;
  std::vector<bool> is_shared;
  for (const int v : left) {
    whole.push_back(slab.whole[at(v)]);
    is_shared.push_back(slab.is_shared[at(v)]);
  }
  slab.whole = std::move(whole);
  slab.is_shared = std::move(is_shared);
}

}  // namespace

Interfaces simplify(const Interfaces& interfaces, const SimplifySettings& settings, const NearPlaces& kept,
                    int threads) {
  std::vector<Slab> slabs = split_into_slabs(interfaces);
  for_each_index(slabs.size(), threads, [&](std::size_t s) { simplify_slab(slabs[s], settings, kept); });
  if (slabs.size() == 1) return slabs[0].interfaces;
  Simplifier simplifier(join_slabs(slabs, interfaces.positions_m.size()), settings);
  simplifier.freeze(kept);
  simplifier.run();
  return simplifier.take();
}

}  // namespace myotact::prepare
