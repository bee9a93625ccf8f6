#include "simulation/muscle/fascia_bonds.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "core/at.h"

namespace myotact::simulation {
namespace {

/// Two surfaces lie side by side where their normals are this close to opposite: within 60 degrees.
constexpr double kFacing = -0.5;
/// A bond's place is carried on once its node has slid this far along the face: over a surface of 10 mm radius it then
/// jumps by 0.05 mm across, and so does the force by a hundredth of a newton.
constexpr double kSlidFar_m = 1e-3;
/// Triangles that a bond crosses at once at most: many times kSlidFar_m.
constexpr int kMostCrossed = 8;

/// The tet that a flat triangle of the surface belongs to.
std::size_t tet_of(const geometry::TetMesh& mesh, const std::array<int, 3>& triangle) {
  for (std::size_t t = 0; t < mesh.corners.size(); ++t) {
    const auto holds = [&](int node) {
      const auto& corners = mesh.corners[t];
      if (std::find(corners.begin(), corners.end(), node) != corners.end()) return true;
      return mesh.quadratic() &&
             std::find(mesh.midsides[t].begin(), mesh.midsides[t].end(), node) != mesh.midsides[t].end();
    };
    if (std::all_of(triangle.begin(), triangle.end(), holds)) return t;
  }
  return 0;  // not reached: every triangle of the surface is a tet's
}

/// Where p lies in a tet by its corners, or beside it.
std::array<double, 4> place_in_tet(const geometry::TetMesh& mesh, const std::array<int, 4>& corners, const Vec3& p) {
  Eigen::Matrix4d columns;
  for (Eigen::Index k = 0; k < 4; ++k) columns.col(k) << mesh.nodes_m[at(corners[static_cast<std::size_t>(k)])], 1.0;
  const Eigen::Vector4d weights = columns.inverse() * Eigen::Vector4d(p.x(), p.y(), p.z(), 1.0);
  return {weights[0], weights[1], weights[2], weights[3]};
}

/// The neighbour nearest to a node, at the file pose. `other` -1: none within reach.
FasciaBond bond_of(const std::vector<MuscleTissue*>& tissues, const Fascia& fascia,
                   const std::vector<TouchSurface>& surfaces, int muscle, int index) {
  const TouchSurface& surface = surfaces[at(muscle)];
  const int node = surface.nodes[at(index)].node;
  const Vec3& p = tissues[at(muscle)]->mesh.nodes_m[at(node)];
  const Vec3 outwards_W = surface.normals_W[at(node)].normalized();
  FasciaBond bond;
  double reach_m = fascia.reach_m;
  for (int other = 0; other < static_cast<int>(surfaces.size()); ++other) {
    if (other == muscle || tissues[at(other)] == nullptr) continue;
    if (surfaces[at(other)].box.exteriorDistance(p) > reach_m) continue;
    const geometry::TetMesh& theirs = tissues[at(other)]->mesh;
    const Under under = face_under(p, surfaces[at(other)], theirs.nodes_m, reach_m);
    if (under.face.triangle < 0 || outwards_W.dot(under.face.normal_W) > kFacing) continue;
    reach_m = under.nearest_m;
    const std::size_t tet = tet_of(theirs, surfaces[at(other)].tree.triangle(under.face.triangle));
    bond = {index,
            other,
            under.place,
            under.place,
            -under.distance_m,
            theirs.corners[tet],
            place_in_tet(theirs, theirs.corners[tet], p)};
  }
  return bond;
}

}  // namespace

void lay_bonds(const std::vector<MuscleTissue*>& tissues, const Fascia& fascia, std::vector<TouchSurface>& surfaces) {
  for (int m = 0; m < static_cast<int>(surfaces.size()); ++m) {
    TouchSurface& surface = surfaces[at(m)];
    for (int i = 0; i < static_cast<int>(surface.nodes.size()); ++i) {
      const FasciaBond bond = bond_of(tissues, fascia, surfaces, m, i);
      if (bond.other < 0) continue;
      surface.held_by[at(i)] = bond.other;
      surface.bonds.push_back(bond);
    }
  }
}

namespace {

/// The place nearest to p that is reached from `start` through triangles of which each is nearer than the last.
geometry::SurfacePlace nearest_from(const Vec3& p, const TouchSurface& other, std::span<const Vec3> positions_m,
                                    int start) {
  const auto place_on = [&](int triangle) {
    const auto& [a, b, c] = other.tree.triangle(triangle);
    geometry::SurfacePlace place;
    place.triangle = triangle;
    place.point = geometry::closest_point_on_triangle(p, positions_m[at(a)], positions_m[at(b)], positions_m[at(c)]);
    place.distance_m = (p - place.point.position_m).norm();
    return place;
  };
  geometry::SurfacePlace nearest = place_on(start);
  for (int crossed = 0; crossed < kMostCrossed; ++crossed) {
    const int from = nearest.triangle;
    const std::array<double, 3> weights = nearest.point.barycentric;
    for (std::size_t k = 0; k < 3; ++k) {
      if (weights[k] <= 0.0) continue;  // the corner across
      for (const int next : other.around[at(other.tree.triangle(from)[k])]) {
        if (const geometry::SurfacePlace place = place_on(next); place.distance_m < nearest.distance_m) nearest = place;
      }
    }
    if (nearest.triangle == from) break;
  }
  return nearest;
}

Vec3 position_of(const geometry::SurfacePlace& place, const TouchSurface& other, std::span<const Vec3> positions_m) {
  Vec3 position_m = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    position_m += place.point.barycentric[k] * positions_m[at(other.tree.triangle(place.triangle)[k])];
  }
  return position_m;
}

}  // namespace

TouchSurface::Found slide_bond(const Vec3& p, const TouchSurface& other, std::span<const Vec3> positions_m,
                               FasciaBond& bond) {
  TouchSurface::Found face = face_at(other, bond.place);
  const Vec3 way_m = p - position_of(bond.place, other, positions_m);
  if (face.triangle < 0 || (way_m - face.normal_W * face.normal_W.dot(way_m)).norm() > kSlidFar_m) {
    bond.place = nearest_from(p, other, positions_m, bond.place.triangle);
    face = face_at(other, bond.place);
  }
  face.node = bond.node;
  face.other = bond.other;
  return face;
}

}  // namespace myotact::simulation
