#include "simulation/muscle/touch_surface.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/at.h"
#include "geometry/pseudo_normals.h"
#include "geometry/tet_topology.h"
#include "simulation/muscle/tissue_pass.h"

namespace myotact::simulation {
namespace {

/// A node that lies deeper than this in a neighbour at the file pose touches it nowhere.
constexpr double kDeepestRest_m = 4e-3;

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

}  // namespace

std::span<const Vec3> as_points(const Eigen::VectorXd& values) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return {reinterpret_cast<const Vec3*>(values.data()), at(static_cast<int>(values.size() / 3))};
}

double farthest_way_m(const Eigen::VectorXd& position_m, const TouchSurface& surface) {
  double farthest_m2 = 0.0;
  for (Eigen::Index i = 0; i < position_m.size(); i += 3) {
    const double way_m2 = (position_m.segment<3>(i) - surface.searched_at_m.segment<3>(i)).squaredNorm();
    farthest_m2 = std::max(farthest_m2, way_m2);
  }
  return std::sqrt(farthest_m2);
}

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

TouchSurface::Found face_at(const TouchSurface& other, const geometry::SurfacePlace& place) {
  const std::array<int, 3>& corners = other.tree.triangle(place.triangle);
  Vec3 normal = Vec3::Zero();
  for (std::size_t c = 0; c < 3; ++c) {
    normal += place.point.barycentric[c] * other.normals_W[at(corners[c])].normalized();
  }
  TouchSurface::Found face;
  if (!(normal.norm() > 0.1)) return face;  // a fold: no side is outside
  face.triangle = place.triangle;
  face.weights = place.point.barycentric;
  face.normal_W = normal.normalized();
  return face;
}

Under face_under(const Vec3& p, const TouchSurface& other, std::span<const Vec3> positions_m, double radius_m) {
  Under under;
  const geometry::SurfacePlace place = other.tree.nearest(p, positions_m, radius_m);
  under.nearest_m = place.distance_m;
  if (place.triangle < 0) return under;
  under.place = place;
  under.face = face_at(other, place);
  if (under.face.triangle < 0) return under;
  const Vec3 way = p - place.point.position_m;
  under.distance_m = under.face.normal_W.dot(way);
  if (under.distance_m >= 0.0) return under;
  const bool inside = geometry::pseudo_normal(other.tree, other.around, positions_m, place).dot(way) < 0.0;
  if (!inside) under.face.triangle = -1;
  return under;
}

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
    surfaces[m].around = geometry::triangles_around(surfaces[m].tree, surfaces[m].normals_W.size());
    surfaces[m].held_by.assign(surfaces[m].nodes.size(), -1);
    surfaces[m].clear_until_m.resize(tissues.size());
    surfaces[m].last_triangles.resize(tissues.size());
    surfaces[m].searched_at_m = make_state(tissue).now.position_m;
    follow(surfaces[m].searched_at_m, surfaces[m]);
  }
  measure_rest_depths(tissues, surfaces);
  return surfaces;
}

}  // namespace myotact::simulation
