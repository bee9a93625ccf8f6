#include "simulation/touch_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "geometry/tet_topology.h"
#include "simulation/limb.h"

namespace myotact::simulation {
namespace {

/// Surfaces closer than this are watched during a step: neighbours slide past each other at 0.2 m/s at most, so that
/// they meet within a step of 10 ms.
constexpr double kWatched_m = 2e-3;
/// Where nothing is found within this way beyond, a node is not looked at again until both muscles have travelled it.
constexpr double kLookAhead_m = 4e-3;
/// Faces under nodes stay until a node has moved this far [m]: a fiftieth of a face.
constexpr double kStill_m = 0.1e-3;
/// A node that lies deeper than this in a neighbour at the file pose touches it nowhere.
constexpr double kDeepestRest_m = 4e-3;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

/// Nodal positions as points. Vec3 is three packed doubles.
std::span<const Vec3> as_points(const Eigen::VectorXd& values) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return {reinterpret_cast<const Vec3*>(values.data()), at(static_cast<int>(values.size() / 3))};
}

geometry::TriangleMesh flat_surface(const geometry::TetMesh& mesh) {
  geometry::TriangleMesh surface{mesh.nodes_m, {}};
  for (const geometry::BoundaryTriangle& face : geometry::boundary_triangles(mesh)) {
    const auto& [a, b, c] = face.corners;
    if (!mesh.quadratic()) {
      surface.triangles.push_back({a, b, c});
      continue;
    }
    const auto& [ab, bc, ca] = face.midsides;
    surface.triangles.insert(surface.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return surface;
}

/// The largest way of a node since the last search.
double farthest_way_m(const Eigen::VectorXd& position_m, const TouchSurface& surface) {
  double farthest_m2 = 0.0;
  for (Eigen::Index i = 0; i < position_m.size(); i += 3) {
    const double way_m2 = (position_m.segment<3>(i) - surface.searched_at_m.segment<3>(i)).squaredNorm();
    farthest_m2 = std::max(farthest_m2, way_m2);
  }
  return std::sqrt(farthest_m2);
}

/// Tree, box and normals at these positions.
void follow(const Eigen::VectorXd& position_m, TouchSurface& surface) {
  const std::span<const Vec3> positions_m = as_points(position_m);
  surface.travelled_m += farthest_way_m(position_m, surface);
  surface.searched_at_m = position_m;
  surface.tree.refit(positions_m);
  surface.box.setEmpty();
  std::fill(surface.normals_W.begin(), surface.normals_W.end(), Vec3::Zero());
  for (int t = 0; t < surface.tree.triangle_count(); ++t) {
    const std::array<int, 3>& corners = surface.tree.triangle(t);
    const Vec3 &a = positions_m[at(corners[0])], &b = positions_m[at(corners[1])], &c = positions_m[at(corners[2])];
    const Vec3 normal = (b - a).cross(c - a);
    for (const int corner : corners) {
      surface.normals_W[at(corner)] += normal;
      surface.box.extend(positions_m[at(corner)]);
    }
  }
}

struct Under {
  TouchSurface::Found face;
  double distance_m = 0.0;                                     // along the normal, < 0 inside
  double nearest_m = std::numeric_limits<double>::infinity();  // distance of the face, no sign
};

/// The face of `other` nearest to p, within the radius; face.triangle -1 when none is. The normal turns smoothly from
/// one flat triangle to the next.
Under face_under(const Vec3& p, const TouchSurface& other, std::span<const Vec3> positions_m, double radius_m) {
  Under under;
  const geometry::SurfacePlace place = other.tree.nearest(p, positions_m, radius_m);
  under.nearest_m = place.distance_m;
  if (place.triangle < 0) return under;
  const std::array<int, 3>& corners = other.tree.triangle(place.triangle);
  Vec3 normal = Vec3::Zero();
  for (std::size_t c = 0; c < 3; ++c) {
    normal += place.point.barycentric[c] * other.normals_W[at(corners[c])].normalized();
  }
  if (!(normal.norm() > 0.1)) return under;  // a fold: no side is outside
  under.face.triangle = place.triangle;
  under.face.weights = place.point.barycentric;
  under.face.normal_W = normal.normalized();
  under.distance_m = under.face.normal_W.dot(p - place.point.position_m);
  return under;
}

/// At the file pose, where everything stands as meshed.
void measure_rest_depths(const std::vector<MuscleTissue*>& tissues, std::vector<TouchSurface>& surfaces) {
  for (std::size_t m = 0; m < surfaces.size(); ++m) {
    surfaces[m].rest_depths_m.resize(surfaces.size());
    for (std::size_t o = 0; o < surfaces.size(); ++o) {
      if (o == m || tissues[o] == nullptr) continue;
      const std::vector<Vec3>& theirs = tissues[o]->mesh.nodes_m;
      std::vector<double> depths_m(surfaces[m].nodes.size(), 0.0);
      bool any = false;
      for (std::size_t i = 0; i < depths_m.size(); ++i) {
        const Vec3& p = tissues[m]->mesh.nodes_m[at(surfaces[m].nodes[i].node)];
        if (!surfaces[o].box.contains(p)) continue;
        const Under under = face_under(p, surfaces[o], theirs, surfaces[o].box.diagonal().norm());
        if (under.face.triangle < 0 || under.distance_m >= 0.0) continue;
        depths_m[i] = under.distance_m < -kDeepestRest_m ? -1.0 : -under.distance_m;
        any = true;
      }
      if (any) surfaces[m].rest_depths_m[o] = std::move(depths_m);
    }
  }
}

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

std::vector<TouchSurface> make_touch_surfaces(const std::vector<MuscleTissue*>& tissues) {
  std::vector<TouchSurface> surfaces(tissues.size());
  for (std::size_t m = 0; m < tissues.size(); ++m) {
    if (tissues[m] == nullptr) continue;
    const MuscleTissue& tissue = *tissues[m];
    for (const SurfaceNode& node : surface_nodes(tissue.mesh, tissue.body, -1)) {
      if (tissue.body[at(node.node)] < 0) surfaces[m].nodes.push_back(node);
    }
    surfaces[m].tree = geometry::TriangleTree(flat_surface(tissue.mesh));
    surfaces[m].normals_W.resize(tissue.mesh.nodes_m.size());
    surfaces[m].clear_until_m.resize(tissues.size());
    surfaces[m].last_triangles.resize(tissues.size());
    surfaces[m].searched_at_m = make_state(tissue).now.position_m;
    follow(surfaces[m].searched_at_m, surfaces[m]);
  }
  measure_rest_depths(tissues, surfaces);
  return surfaces;
}

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
