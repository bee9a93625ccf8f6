#include "simulation/limb/find_touches.h"

#include <algorithm>
#include <limits>
#include <span>

#include "core/at.h"

namespace myotact::simulation {
namespace {

/// Surfaces closer than this are watched during a step: neighbours slide past each other at 0.2 m/s at most, so that
/// they meet within a step of 10 ms.
constexpr double kWatched_m = 2e-3;
/// Where nothing is found within this way beyond, a node is not looked at again until both muscles have travelled it.
constexpr double kLookAhead_m = 4e-3;
/// Faces under nodes stay until a node has moved this far [m]: a fiftieth of a face.
constexpr double kStill_m = 0.1e-3;
/// Of a point from a triangle; infinite from none.
double distance_m(const Vec3& p, const geometry::TriangleTree& tree, int triangle, std::span<const Vec3> positions_m) {
  if (triangle < 0) return std::numeric_limits<double>::infinity();
  const auto& [a, b, c] = tree.triangle(triangle);
  const Vec3 nearest =
      geometry::closest_point_on_triangle(p, positions_m[at(a)], positions_m[at(b)], positions_m[at(c)]).position_m;
  return (nearest - p).norm();
}

/// Faces of one neighbour under the nodes of a muscle.
void search(const Limb& limb, int other, const Eigen::VectorXd& position_m, TouchSurface& surface) {
  const TouchSurface& theirs = limb.touch_surfaces[at(other)];
  Eigen::AlignedBox3d reach = theirs.box;
  reach.min().array() -= kWatched_m;
  reach.max().array() += kWatched_m;
  if (!reach.intersects(surface.box)) return;
  const std::span<const Vec3> positions_m = as_points(limb.muscles[at(other)].state.now.position_m);
  const std::vector<double>& depths_m = surface.rest_depths_m[at(other)];
  surface.clear_until_m[at(other)].resize(surface.nodes.size(), 0.0);
  surface.last_triangles[at(other)].resize(surface.nodes.size(), -1);
  for (std::size_t i = 0; i < surface.nodes.size(); ++i) {
    const Vec3 p = node_vector(position_m, surface.nodes[i].node);
    if (!reach.contains(p)) continue;
    const double rest_depth_m = depths_m.empty() ? 0.0 : depths_m[i];
    double& clear_until_m = surface.clear_until_m[at(other)][i];
    const double travelled_m = surface.travelled_m + theirs.travelled_m;
    if (rest_depth_m < 0.0 || travelled_m < clear_until_m) continue;
    const double reach_m = rest_depth_m + 1.5 * kWatched_m;
    int& last_triangle = surface.last_triangles[at(other)][i];
    const double no_farther_m = distance_m(p, theirs.tree, last_triangle, positions_m);
    const double radius_m = std::min(reach_m + kLookAhead_m, no_farther_m * (1.0 + 1e-12));
    const Under under = face_under(p, theirs, positions_m, radius_m);
    last_triangle = under.face.triangle;
    clear_until_m = travelled_m + std::min(under.nearest_m - reach_m, kLookAhead_m);
    if (under.nearest_m > reach_m) continue;
    if (under.face.triangle < 0 || under.distance_m + rest_depth_m > kWatched_m) continue;
    surface.found.push_back(under.face);
    surface.found.back().node = static_cast<int>(i);
    surface.found.back().other = other;
  }
}

/// The touch as both muscles see it.
void add_touch(Limb& limb, int muscle, const TouchSurface::Found& found) {
  const TouchSurface& surface = limb.touch_surfaces[at(muscle)];
  const MuscleTissue& theirs = limb.muscles[at(found.other)].tissue;
  const std::vector<double>& depths_m = surface.rest_depths_m[at(found.other)];
  std::vector<NeighbourTouch>& own = limb.muscles[at(muscle)].state.touches;
  std::vector<NeighbourTouch>& others = limb.muscles[at(found.other)].state.touches;
  NeighbourTouch touch;
  touch.normal_W = found.normal_W;
  // Each of the two surfaces touches the other with its own nodes: half the pressure each.
  touch.area_m2 = 0.5 * surface.nodes[at(found.node)].area_m2;
  touch.rest_depth_m = depths_m.empty() ? 0.0 : depths_m[at(found.node)];
  const std::array<int, 3>& corners = limb.touch_surfaces[at(found.other)].tree.triangle(found.triangle);
  for (std::size_t k = 0; k < 3; ++k) {
    touch.rider_bodies[k] = theirs.body[at(corners[k])];
    touch.riders_rest_m[k] = theirs.mesh.nodes_m[at(corners[k])];
    touch.rider_weights[k] = found.weights[k];
  }
  NeighbourTouch side = touch;
  touch.count = 1;
  touch.nodes[0] = surface.nodes[at(found.node)].node;
  touch.weights[0] = -1.0;
  touch.neighbour = found.other;
  touch.counterpart = static_cast<int>(others.size());
  side.count = 3;
  side.nodes = corners;
  side.weights = found.weights;
  side.neighbour = muscle;
  side.counterpart = static_cast<int>(own.size());
  side.touched = true;
  own.push_back(touch);
  others.push_back(side);
}

}  // namespace

void find_touches(Limb& limb, WorkerPool& workers) {
  if (limb.touch_surfaces.empty()) return;
  const int count = static_cast<int>(limb.muscles.size());
  workers.run(count, [&](int m) {
    if (!limb.muscles[at(m)].rigid) {
      follow(limb.muscles[at(m)].state.now.position_m, limb.touch_surfaces[at(m)]);
    }
  });
  workers.run(count, [&](int m) {
    TouchSurface& surface = limb.touch_surfaces[at(m)];
    surface.found.clear();
    for (int other = 0; other < count; ++other) {
      const bool touchable = other != m && !limb.muscles[at(m)].rigid && !limb.muscles[at(other)].rigid;
      if (touchable) search(limb, other, limb.muscles[at(m)].state.now.position_m, surface);
    }
  });
  for (LimbMuscle& muscle : limb.muscles) muscle.state.touches.clear();
  for (int m = 0; m < count; ++m) {
    for (const TouchSurface::Found& found : limb.touch_surfaces[at(m)].found) add_touch(limb, m, found);
  }
  see_neighbours(limb);
}

void follow_touches(Limb& limb, WorkerPool& workers) {
  bool still = true;
  for (std::size_t m = 0; m < limb.touch_surfaces.size() && still; ++m) {
    still = limb.muscles[m].rigid ||
            farthest_way_m(limb.muscles[m].state.now.position_m, limb.touch_surfaces[m]) < kStill_m;
  }
  if (still)
    see_neighbours(limb);
  else
    find_touches(limb, workers);
}

void see_neighbours(Limb& limb) {
  for (LimbMuscle& muscle : limb.muscles) {
    for (NeighbourTouch& touch : muscle.state.touches) {
      const LimbMuscle& other = limb.muscles[at(touch.neighbour)];
      const NeighbourTouch& theirs = other.state.touches[at(touch.counterpart)];
      touch.others_m = -touch.rest_depth_m;
      for (std::size_t k = 0; k < at(theirs.count); ++k) {
        const Vec3 x = node_vector(other.state.now.position_m, theirs.nodes[k]);
        touch.others_m += theirs.weights[k] * touch.normal_W.dot(x);
      }
    }
  }
}

}  // namespace myotact::simulation
