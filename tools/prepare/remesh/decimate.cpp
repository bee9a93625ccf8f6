#include "prepare/remesh/decimate.h"

#include <algorithm>
#include <queue>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "prepare/remesh/even_out.h"
#include "prepare/remesh/guarded_mesh.h"
#include "prepare/remesh/restore_volume.h"

namespace myotact::prepare {

namespace {

/// Edges beyond this multiple of the wanted length are not made (Botsch and Kobbelt 2004).
constexpr double kLongest = 4.0 / 3.0;
/// Edges beyond this multiple are left alone: collapsing them makes too long ones.
constexpr double kShortest = 0.9;
/// Weight of a vertex's own place in its quadric, against that of the planes around: where these leave a direction
/// free, vertices stay evenly spread.
constexpr double kOwnPlace = 1e-3;

/// Rounds of evening after a decimation; more change the shapes by less than 2 %.
constexpr int kEveningRounds = 2;
/// Rounds of collapsing, evening and swelling: each makes room for the next.
constexpr int kCoarseningRounds = 4;

/// Sum of squared distances to planes, weighted by area: x.A x - 2 b.x + c.
struct Quadric {
  Mat3 a = Mat3::Zero();
  Vec3 b = Vec3::Zero();
  double c = 0.0;

  void add_plane(const Vec3& normal, const Vec3& point, double weight) {
    const double offset = normal.dot(point);
    a += weight * normal * normal.transpose();
    b += weight * offset * normal;
    c += weight * offset * offset;
  }
  void add_point(const Vec3& point, double weight) {
    a += weight * Mat3::Identity();
    b += weight * point;
    c += weight * point.squaredNorm();
  }
  Quadric operator+(const Quadric& other) const { return {a + other.a, b + other.b, c + other.c}; }
  double at(const Vec3& x) const { return x.dot(a * x) - 2.0 * b.dot(x) + c; }
};

enum class Order { LeastChange, Shortest };

class Decimator {
 public:
  Decimator(GuardedMesh& guarded, const DecimateSettings& settings, Order order)
      : guarded_(guarded), settings_(settings), order_(order) {
    const HalfEdgeMesh& mesh = guarded_.mesh();
    quadrics_.resize(mesh.n_vertices());
    versions_.assign(mesh.n_vertices(), 0);
    for (const auto f : mesh.faces()) {
      if (mesh.status(f).deleted()) continue;
      const auto ids = guarded_.vertices_of(f.idx());
      const Corners x = guarded_.corners_of(ids);
      const Vec3 area = 0.5 * (x[1] - x[0]).cross(x[2] - x[0]);
      for (std::size_t i = 0; i < 3; ++i) {
        quadrics_[static_cast<std::size_t>(ids[i])].add_plane(area.normalized(), x[i], area.norm() / 3.0);
        quadrics_[static_cast<std::size_t>(ids[i])].add_point(x[i], kOwnPlace * area.norm() / 3.0);
      }
    }
    for (const auto e : mesh.edges()) {
      if (!mesh.status(e).deleted()) offer(e);
    }
  }

  void run() {
    while (!queue_.empty()) {
      const Candidate next = queue_.top();
      queue_.pop();
      if (is_current(next)) collapse(OpenMesh::EdgeHandle(next.edge));
    }
  }

 private:
  struct Candidate {
    double cost;
    int edge;
    int version;  // of both ends together
    bool operator>(const Candidate& other) const { return cost != other.cost ? cost > other.cost : edge > other.edge; }
  };

  std::array<std::size_t, 2> ends(OpenMesh::EdgeHandle e) const {
    const auto h = guarded_.mesh().halfedge_handle(e, 0);
    return {static_cast<std::size_t>(guarded_.mesh().from_vertex_handle(h).idx()),
            static_cast<std::size_t>(guarded_.mesh().to_vertex_handle(h).idx())};
  }

  bool is_current(const Candidate& candidate) const {
    const OpenMesh::EdgeHandle e(candidate.edge);
    if (guarded_.mesh().status(e).deleted()) return false;
    const auto [a, b] = ends(e);
    return candidate.version == versions_[a] + versions_[b];
  }

  static Vec3 best_place(const Quadric& q) { return q.a.ldlt().solve(q.b); }

  void offer(OpenMesh::EdgeHandle e) {
    if (guarded_.length_m(e) > kShortest * settings_.edge_m) return;
    const auto [a, b] = ends(e);
    const Quadric q = quadrics_[a] + quadrics_[b];
    const double strays_m2 = q.at(best_place(q)) / q.a.trace();  // mean square distance to the planes
    if (strays_m2 > settings_.tolerance_m * settings_.tolerance_m) return;
    const double cost = order_ == Order::Shortest ? guarded_.length_m(e) : q.at(best_place(q));
    queue_.push({cost, e.idx(), versions_[a] + versions_[b]});
  }

  void collapse(OpenMesh::EdgeHandle e) {
    const HalfEdgeMesh& mesh = guarded_.mesh();
    const auto [a, b] = ends(e);
    const Quadric q = quadrics_[a] + quadrics_[b];
    const auto h = mesh.halfedge_handle(e, 0);
    const auto kept = mesh.to_vertex_handle(h);
    const Vec3 from_m = guarded_.position_m(mesh.from_vertex_handle(h)), to_m = guarded_.position_m(kept);
    const Vec3 middle_m = 0.5 * (from_m + to_m);
    std::array<Vec3, 4> places_m{best_place(q), middle_m, from_m, to_m};
    if (!((places_m[0] - middle_m).norm() < settings_.edge_m)) places_m[0] = middle_m;  // an ill-posed minimum
    const std::ptrdiff_t tried = order_ == Order::Shortest ? 4 : 1;  // many edges: the best place, or none
    const bool done = std::any_of(places_m.begin(), places_m.begin() + tried, [&](const Vec3& place_m) {
      return !makes_long_edge(h, place_m) && guarded_.try_collapse(h, place_m, settings_.least_shape);
    });
    if (!done) return;
    const auto v = static_cast<std::size_t>(kept.idx());
    quadrics_[v] = q;
    versions_[v] = versions_[a] + versions_[b] + 1;
    for (auto edge = mesh.cve_iter(kept); edge.is_valid(); ++edge) offer(*edge);
  }

  bool makes_long_edge(OpenMesh::HalfedgeHandle h, const Vec3& place_m) const {
    const HalfEdgeMesh& mesh = guarded_.mesh();
    for (const auto end : {mesh.from_vertex_handle(h), mesh.to_vertex_handle(h)}) {
      for (auto v = mesh.cvv_iter(end); v.is_valid(); ++v) {
        if ((guarded_.position_m(*v) - place_m).norm() > kLongest * settings_.edge_m) return true;
      }
    }
    return false;
  }

  GuardedMesh& guarded_;
  const DecimateSettings& settings_;
  Order order_;
  std::vector<Quadric> quadrics_;
  std::vector<int> versions_;  // by vertex: rises with every change
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue_;
};

}  // namespace

geometry::TriangleMesh decimate(const geometry::TriangleMesh& surface, const DecimateSettings& settings) {
  GuardedMesh guarded(surface, surface, settings.tolerance_m, settings.edge_m);
  Decimator(guarded, settings, Order::LeastChange).run();
  even_out(guarded, settings.edge_m, kEveningRounds);
  restore_volume(guarded, geometry::enclosed_volume_m3(surface));  // chords of round parts lie inside
  return guarded.take();
}

geometry::TriangleMesh coarsen(const geometry::TriangleMesh& surface, const DecimateSettings& settings) {
  GuardedMesh guarded(surface, surface, settings.tolerance_m, settings.edge_m);
  for (int round = 0; round < kCoarseningRounds; ++round) {
    Decimator(guarded, settings, Order::Shortest).run();
    even_out(guarded, settings.edge_m, kCoarseningRounds);
    restore_volume(guarded, geometry::enclosed_volume_m3(surface));
  }
  return guarded.take();
}

}  // namespace myotact::prepare
