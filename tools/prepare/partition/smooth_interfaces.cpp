#include "prepare/partition/smooth_interfaces.h"

#include <algorithm>
#include <vector>

#include <boost/container/small_vector.hpp>

#include "core/at.h"
#include "prepare/partition/meetings.h"

namespace myotact::prepare {

namespace {

/// Places are evened out up to so many triangles from a line, those farthest away half as much.
constexpr int kRings = 3;
/// How far a place goes towards the middle of its neighbours and back, and how often: waves of eight edges and more,
/// some three steps, keep three quarters and more of their height, those of four edges nothing.
constexpr double kThere = 0.5, kBack = -0.53;
constexpr int kRounds = 20;

class Smoother {
 public:
  explicit Smoother(const Interfaces& interfaces) : mesh_(interfaces), faces_at_(interfaces.positions_m.size()) {
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      for (const int v : mesh_.faces[f].vertices) faces_at_[at(v)].push_back(static_cast<int>(f));
    }
    for (std::size_t v = 0; v < faces_at_.size(); ++v) is_line_.push_back(labels_of(mesh_, faces_at_[v]).size() > 2);
    measure_rings();
  }

  Interfaces run() {
    std::vector<int> moving;
    std::vector<Indices> neighbours;
    for (std::size_t v = 0; v < ring_.size(); ++v) {
      if (ring_[v] > kRings) continue;
      moving.push_back(static_cast<int>(v));
      neighbours.push_back(evened_with(static_cast<int>(v)));
    }
    for (int round = 0; round < kRounds; ++round) {
      for (const double part : {kThere, kBack}) step(moving, neighbours, part);
    }
    return std::move(mesh_);
  }

 private:
  Indices around(int vertex) const { return neighbours_of(mesh_, faces_at_[at(vertex)], vertex); }

  bool is_line_edge(int a, int b) const { return labels_of(mesh_, faces_with(mesh_, faces_at_[at(a)], b)).size() > 2; }

  /// Those that a vertex is evened out with: on a line, the line's.
  Indices evened_with(int vertex) const {
    Indices result = around(vertex);
    if (!is_line_[at(vertex)]) return result;
    result.erase(std::remove_if(result.begin(), result.end(),
                                [&](int other) { return !is_line_[at(other)] || !is_line_edge(vertex, other); }),
                 result.end());
    return result;
  }

  /// How many triangles each vertex is from a line.
  void measure_rings() {
    ring_.assign(is_line_.size(), kRings + 1);
    std::vector<int> open;
    for (std::size_t v = 0; v < ring_.size(); ++v) {
      if (is_line_[v]) ring_[v] = 0, open.push_back(static_cast<int>(v));
    }
    for (std::size_t next = 0; next < open.size(); ++next) {
      const int further = ring_[at(open[next])] + 1;
      if (further > kRings) break;
      for (const int v : around(open[next])) {
        if (ring_[at(v)] > further) ring_[at(v)] = further, open.push_back(v);
      }
    }
  }

  void step(const std::vector<int>& moving, const std::vector<Indices>& neighbours, double part) {
    std::vector<Vec3> moved_m(moving.size());
    for (std::size_t i = 0; i < moving.size(); ++i) {
      const Vec3& here_m = mesh_.positions_m[at(moving[i])];
      Vec3 middle_m = Vec3::Zero();
      for (const int v : neighbours[i]) middle_m += mesh_.positions_m[at(v)];
      moved_m[i] = here_m;
      if (neighbours[i].empty()) continue;
      middle_m /= static_cast<double>(neighbours[i].size());
      moved_m[i] += (ring_[at(moving[i])] == kRings ? 0.5 : 1.0) * part * (middle_m - here_m);
    }
    for (std::size_t i = 0; i < moving.size(); ++i) mesh_.positions_m[at(moving[i])] = moved_m[i];
  }

  Interfaces mesh_;
  std::vector<boost::container::small_vector<int, 8>> faces_at_;
  std::vector<bool> is_line_;
  std::vector<int> ring_;
};

}  // namespace

Interfaces smooth_interfaces(const Interfaces& interfaces) {
  return Smoother(interfaces).run();
}

}  // namespace myotact::prepare
