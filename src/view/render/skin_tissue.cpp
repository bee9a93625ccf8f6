#include "view/render/skin_tissue.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>

#include "core/at.h"

namespace myotact::view {

namespace {

/// A thin white sheet over a belly that still shows through it.
constexpr double kAponeurosisShare = 0.55;
/// An edge that runs more than 60 degrees from the fibres does not tell their direction.
constexpr double kAlong = 0.5;
constexpr std::size_t kNearest = 6;  // nodes that a vertex takes from: a tet and its neighbours
/// Nodes nearer than this count alike [m]: far below a tet's size.
constexpr double kNear_m = 5e-4;

double tendon_of(anatomy::TissueRegion region) {
  switch (region) {
    case anatomy::TissueRegion::Belly:
      return 0.0;
    case anatomy::TissueRegion::Tendon:
      return 1.0;
    case anatomy::TissueRegion::Aponeurosis:
      return kAponeurosisShare;
  }
  return 0.0;
}

struct Node {
  Vec3 place_m, fibre = Vec3::Zero();
  double tendon = 0.0;
};

/// At the tets' corners, weighted by volume, in the order of x.
std::vector<Node> nodes_of(const anatomy::Muscle& muscle) {
  std::vector<Node> nodes(muscle.tets.nodes_m.size());
  std::vector<double> volumes_m3(nodes.size(), 0.0);
  for (std::size_t t = 0; t < muscle.tets.corners.size(); ++t) {
    const double volume_m3 = geometry::corner_volume_m3(muscle.tets, t);
    for (const int corner : muscle.tets.corners[t]) {
      Node& node = nodes[at(corner)];
      if (t < muscle.fibres.size()) node.fibre += volume_m3 * muscle.fibres[t];
      if (t < muscle.regions.size()) node.tendon += volume_m3 * tendon_of(muscle.regions[t]);
      volumes_m3[at(corner)] += volume_m3;
    }
  }
  std::vector<Node> used;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!(volumes_m3[i] > 0.0)) continue;  // a mid-side node
    used.push_back({muscle.tets.nodes_m[i], nodes[i].fibre / volumes_m3[i], nodes[i].tendon / volumes_m3[i]});
  }
  std::stable_sort(used.begin(), used.end(),
                   [](const Node& a, const Node& b) { return a.place_m.x() < b.place_m.x(); });
  return used;
}

/// Shepard's weights of the nearest nodes, searched for to both sides along x.
class Nearest {
 public:
  explicit Nearest(const std::vector<Node>& nodes) : nodes_(&nodes) {}

  const std::vector<std::pair<double, std::size_t>>& find(const Vec3& p) {
    found_.clear();
    const auto above = std::lower_bound(nodes_->begin(), nodes_->end(), p.x(),
                                        [](const Node& node, double x) { return node.place_m.x() < x; });
    const auto start = static_cast<std::size_t>(above - nodes_->begin());
    for (std::size_t i = start; i < nodes_->size() && consider(i, p); ++i) {
    }
    for (std::size_t i = start; i > 0 && consider(i - 1, p); --i) {
    }
    return found_;
  }

 private:
  /// False: no node farther on can be among the nearest.
  bool consider(std::size_t i, const Vec3& p) {
    const Vec3 way = (*nodes_)[i].place_m - p;
    const bool full = found_.size() == kNearest;
    if (full && way.x() * way.x() > found_.back().first) return false;
    const std::pair<double, std::size_t> here{way.squaredNorm(), i};
    if (full && here >= found_.back()) return true;
    if (full) found_.pop_back();
    found_.insert(std::upper_bound(found_.begin(), found_.end(), here), here);
    return true;
  }

  const std::vector<Node>* nodes_;
  std::vector<std::pair<double, std::size_t>> found_;  // squared distance, node
};

Vec3 axis_of(const anatomy::MuscleLine* line) {
  if (line == nullptr || line->points.size() < 2) return Vec3::UnitZ();
  const Vec3 way = line->points.back().position_m - line->points.front().position_m;
  return way.norm() > 0.0 ? Vec3(way.normalized()) : Vec3(Vec3::UnitZ());
}

struct Edge {
  int to = 0;
  double length_m = 0.0;
};

std::vector<std::vector<Edge>> edges_of(const geometry::TriangleMesh& surface) {
  std::vector<std::vector<Edge>> edges(surface.positions_m.size());
  for (const auto& triangle : surface.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = triangle[k], b = triangle[(k + 1) % 3];
      const double length_m = (surface.positions_m[at(a)] - surface.positions_m[at(b)]).norm();
      edges[at(a)].push_back({b, length_m});
      edges[at(b)].push_back({a, length_m});
    }
  }
  return edges;
}

}  // namespace

SkinTissue skin_tissue(const anatomy::Muscle& muscle, const anatomy::MuscleLine* line) {
  const Vec3 axis = axis_of(line);
  const std::size_t count = muscle.skin.positions_m.size();
  SkinTissue tissue{std::vector<Vec3>(count, axis), std::vector<float>(count, 0.0f)};
  const std::vector<Node> nodes = nodes_of(muscle);
  Nearest nearest(nodes);
  for (std::size_t i = 0; i < count && !nodes.empty(); ++i) {
    Vec3 fibre = Vec3::Zero();
    double tendon = 0.0, weights = 0.0;
    for (const auto& [squared_m2, node] : nearest.find(muscle.skin.positions_m[i])) {
      const double weight = 1.0 / (squared_m2 + kNear_m * kNear_m);
      fibre += weight * nodes[node].fibre;
      tendon += weight * nodes[node].tendon;
      weights += weight;
    }
    if (fibre.norm() > 1e-9 * weights) tissue.fibres[i] = fibre.normalized();
    tissue.tendons[i] = static_cast<float>(std::clamp(tendon / weights, 0.0, 1.0));
  }
  limit_slope(muscle.skin, kTendonBlend_m, tissue.tendons);
  return tissue;
}

void limit_slope(const geometry::TriangleMesh& surface, double way_m, std::vector<float>& values) {
  const auto edges = edges_of(surface);
  using Reached = std::pair<float, int>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  for (std::size_t i = 0; i < values.size(); ++i) open.emplace(values[i], static_cast<int>(i));
  while (!open.empty()) {
    const auto [value, from] = open.top();
    open.pop();
    if (value > values[at(from)]) continue;  // lowered since
    for (const Edge& edge : edges[at(from)]) {
      const float most = value + static_cast<float>(edge.length_m / way_m);
      if (!(most < values[at(edge.to)])) continue;
      values[at(edge.to)] = most;
      open.emplace(most, edge.to);
    }
  }
}

std::vector<std::array<int, 2>> neighbours_along(const geometry::TriangleMesh& surface,
                                                 const std::vector<Vec3>& fibres) {
  const auto edges = edges_of(surface);
  std::vector<std::array<int, 2>> neighbours(fibres.size());
  for (std::size_t i = 0; i < fibres.size(); ++i) {
    double ahead = kAlong, behind = -kAlong;
    neighbours[i] = {static_cast<int>(i), static_cast<int>(i)};
    for (const Edge& edge : edges[i]) {
      if (!(edge.length_m > 0.0)) continue;
      const Vec3 way = surface.positions_m[at(edge.to)] - surface.positions_m[i];
      const double along = way.dot(fibres[i]) / edge.length_m;
      if (along > ahead) {
        ahead = along;
        neighbours[i][0] = edge.to;
      }
      if (along < behind) {
        behind = along;
        neighbours[i][1] = edge.to;
      }
    }
  }
  return neighbours;
}

}  // namespace myotact::view
