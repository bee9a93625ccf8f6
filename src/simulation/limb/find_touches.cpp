#include "simulation/limb/find_touches.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

#include "core/at.h"
#include "simulation/muscle/fascia_bonds.h"

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
    if (rest_depth_m < 0.0 || travelled_m < clear_until_m || surface.held_by[i] == other) continue;
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

/// Puts a touch of a node at a place on touch.neighbour into the lists of both muscles. `touch` says all but whose
/// nodes it is between, and how they count.
void add_sides(Limb& limb, int muscle, int node, std::span<const int> place, NeighbourTouch touch) {
  const int other = touch.neighbour;
  const MuscleTissue& theirs = limb.muscles[at(other)].tissue;
  std::vector<NeighbourTouch>& own = limb.muscles[at(muscle)].state.touches;
  std::vector<NeighbourTouch>& others = limb.muscles[at(other)].state.touches;
  for (std::size_t k = 0; k < place.size(); ++k) {
    touch.rider_bodies[k] = theirs.body[at(place[k])];
    touch.riders_rest_m[k] = theirs.mesh.nodes_m[at(place[k])];
  }
  NeighbourTouch side = touch;
  touch.count = 1;
  touch.nodes[0] = node;
  touch.weights[0] = -1.0;
  touch.counterpart = static_cast<int>(others.size());
  side.count = static_cast<int>(place.size());
  std::copy(place.begin(), place.end(), side.nodes.begin());
  side.weights = touch.rider_weights;
  side.neighbour = muscle;
  side.counterpart = static_cast<int>(own.size());
  side.touched = true;
  own.push_back(touch);
  others.push_back(side);
}

/// Over a face. Each of two surfaces touches the other with its own nodes: half the pressure each.
void add_touch(Limb& limb, int muscle, const TouchSurface::Found& found, double rest_depth_m, double tension_Pa_m) {
  const TouchSurface& surface = limb.touch_surfaces[at(muscle)];
  NeighbourTouch touch;
  touch.neighbour = found.other;
  touch.normal_W = found.normal_W;
  touch.area_m2 = 0.5 * surface.nodes[at(found.node)].area_m2;
  touch.tension_Pa_m = tension_Pa_m;
  touch.rest_depth_m = rest_depth_m;
  std::copy(found.weights.begin(), found.weights.end(), touch.rider_weights.begin());
  add_sides(limb, muscle, surface.nodes[at(found.node)].node,
            limb.touch_surfaces[at(found.other)].tree.triangle(found.triangle), touch);
}

void add_tie(Limb& limb, int muscle, const FasciaBond& bond) {
  const SurfaceNode& node = limb.touch_surfaces[at(muscle)].nodes[at(bond.node)];
  NeighbourTouch touch;
  touch.neighbour = bond.other;
  touch.tie = true;
  touch.area_m2 = 0.5 * node.area_m2;
  touch.tension_Pa_m = limb.fascia.shear_Pa_m;
  touch.rider_weights = bond.anchor_weights;
  add_sides(limb, muscle, node.node, bond.anchor, touch);
}

/// What fascia holds: over the faces where it has slid to, and tied to where it was.
void add_bonds(Limb& limb, int muscle) {
  for (FasciaBond& bond : limb.touch_surfaces[at(muscle)].bonds) {
    const TouchSurface& theirs = limb.touch_surfaces[at(bond.other)];
    const Vec3 p = node_vector(limb.muscles[at(muscle)].state.now.position_m,
                               limb.touch_surfaces[at(muscle)].nodes[at(bond.node)].node);
    const TouchSurface::Found face =
        slide_bond(p, theirs, as_points(limb.muscles[at(bond.other)].state.now.position_m), bond);
    if (face.triangle >= 0)
      add_touch(limb, muscle, face, bond.rest_depth_m, limb.fascia.tension_Pa_m - limb.fascia.shear_Pa_m);
    if (limb.fascia.shear_Pa_m > 0.0) add_tie(limb, muscle, bond);
  }
}

using TouchLists = std::vector<std::vector<NeighbourTouch>>;  // one a muscle

/// A muscle touches a neighbour with a node once, and is tied to it by that node once.
bool is_before(const NeighbourTouch* a, const NeighbourTouch* b) {
  return std::tie(a->neighbour, a->tie, a->nodes[0]) < std::tie(b->neighbour, b->tie, b->nodes[0]);
}

/// The touches of one muscle's own nodes that are where they were in `last` get the slopes that they had there, on both
/// sides: muscles that keep their tangent were made with them. Others get new ones with their new tangent.
void keep_slopes(const TouchLists& last, int muscle, Limb& limb) {
  std::vector<const NeighbourTouch*> old;
  for (const NeighbourTouch& touch : last[at(muscle)]) {
    if (!touch.touched) old.push_back(&touch);
  }
  std::sort(old.begin(), old.end(), is_before);
  for (NeighbourTouch& touch : limb.muscles[at(muscle)].state.touches) {
    if (touch.touched) continue;
    const auto found = std::lower_bound(old.begin(), old.end(), &touch, is_before);
    if (found == old.end() || is_before(&touch, *found)) continue;
    NeighbourTouch& side = limb.muscles[at(touch.neighbour)].state.touches[at(touch.counterpart)];
    const NeighbourTouch& old_side = last[at(touch.neighbour)][at((*found)->counterpart)];
    if (side.nodes != old_side.nodes) continue;
    touch.slope_N_m = (*found)->slope_N_m;
    side.slope_N_m = old_side.slope_N_m;
  }
}

/// Faces under the nodes of one muscle. Between two that have not moved those of the last search stay.
void search_around(Limb& limb, int muscle, const std::vector<char>& moved) {
  TouchSurface& surface = limb.touch_surfaces[at(muscle)];
  const std::vector<TouchSurface::Found> last = std::exchange(surface.found, {});
  if (limb.contact != Contact::All || limb.muscles[at(muscle)].rigid) return;
  for (int other = 0; other < static_cast<int>(limb.muscles.size()); ++other) {
    if (other == muscle || limb.muscles[at(other)].rigid) continue;
    if (moved[at(muscle)] || moved[at(other)]) {
      search(limb, other, limb.muscles[at(muscle)].state.now.position_m, surface);
    } else {
      std::copy_if(last.begin(), last.end(), std::back_inserter(surface.found),
                   [&](const TouchSurface::Found& found) { return found.other == other; });
    }
  }
}

/// The touches of all muscles, with new faces beside those that have moved.
void search_where(Limb& limb, const std::vector<char>& moved, WorkerPool& workers) {
  const int count = static_cast<int>(limb.muscles.size());
  workers.run(count, [&](int m) {
    if (moved[at(m)] && !limb.muscles[at(m)].rigid)
      follow(limb.muscles[at(m)].state.now.position_m, limb.touch_surfaces[at(m)]);
  });
  workers.run(count, [&](int m) { search_around(limb, m, moved); });
  TouchLists last(limb.muscles.size());
  for (std::size_t m = 0; m < last.size(); ++m) last[m] = std::exchange(limb.muscles[m].state.touches, {});
  for (int m = 0; m < count; ++m) {
    const TouchSurface& surface = limb.touch_surfaces[at(m)];
    for (const TouchSurface::Found& found : surface.found) {
      const std::vector<double>& depths_m = surface.rest_depths_m[at(found.other)];
      add_touch(limb, m, found, depths_m.empty() ? 0.0 : depths_m[at(found.node)], 0.0);
    }
    add_bonds(limb, m);
  }
  workers.run(count, [&](int m) { keep_slopes(last, m, limb); });
  see_neighbours(limb);
}

}  // namespace

void find_touches(Limb& limb, WorkerPool& workers) {
  if (limb.touch_surfaces.empty()) return;
  search_where(limb, std::vector<char>(limb.muscles.size(), 1), workers);
}

void follow_touches(Limb& limb, WorkerPool& workers) {
  if (limb.touch_surfaces.empty()) return;
  std::vector<char> moved(limb.muscles.size(), 0);
  for (std::size_t m = 0; m < moved.size(); ++m) {
    const LimbMuscle& muscle = limb.muscles[m];
    moved[m] = !muscle.rigid && farthest_way_m(muscle.state.now.position_m, limb.touch_surfaces[m]) >= kStill_m;
  }
  if (std::find(moved.begin(), moved.end(), 1) == moved.end())
    see_neighbours(limb);
  else
    search_where(limb, moved, workers);
}

void see_neighbours(Limb& limb) {
  for (LimbMuscle& muscle : limb.muscles) {
    for (NeighbourTouch& touch : muscle.state.touches) {
      const LimbMuscle& other = limb.muscles[at(touch.neighbour)];
      const NeighbourTouch& theirs = other.state.touches[at(touch.counterpart)];
      touch.others_overlap_m = -touch.rest_depth_m;
      touch.others_m.setZero();
      for (std::size_t k = 0; k < at(theirs.count); ++k) {
        const Vec3 x = node_vector(other.state.now.position_m, theirs.nodes[k]);
        touch.others_overlap_m += theirs.weights[k] * touch.normal_W.dot(x);
        if (touch.tie) touch.others_m += theirs.weights[k] * x;
      }
    }
  }
}

}  // namespace myotact::simulation
