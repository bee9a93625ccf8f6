#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "core/vector.h"
#include "geometry/triangle_tree.h"
#include "simulation/contact/bone_contact.h"
#include "simulation/muscle/muscle_tissue.h"

namespace myotact::simulation {

/// A node of a surface that fascia holds at a neighbour.
struct FasciaBond {
  int node = -1;                           // of the surface's list
  int other = -1;                          // muscle
  geometry::SurfacePlace rest;             // on the other's tree, where the node lay over it at the file pose
  geometry::SurfacePlace place;            // and where it has slid to, material: weights stay, the position does not
  double rest_depth_m = 0.0;               // overlap at the file pose, < 0 where there was a gap
  std::array<int, 4> anchor{};             // corners of a tet of the other
  std::array<double, 4> anchor_weights{};  // sum 1: where in that tet, or beside it, the node was at the file pose
};

/// The surface of a muscle as its neighbours touch it, and which of them it touches. Faces of quadratic tets are four
/// flat triangles.
struct TouchSurface {
  /// A face under a node.
  struct Found {
    int node = -1;                    // of the list below
    int other = -1;                   // muscle
    int triangle = -1;                // of the other's tree; -1: none
    std::array<double, 3> weights{};  // barycentric, on that triangle
    Vec3 normal_W = Vec3::Zero();     // unit, out of the other
  };
  std::vector<SurfaceNode> nodes;  // free ones
  /// How deep each of them lies in each other muscle at the file pose; empty for a muscle that none lies in. Below 0:
  /// too deep to determine which face it lies under, so it touches none.
  std::vector<std::vector<double>> rest_depths_m;
  geometry::TriangleTree tree;  // over the mesh's nodes
  std::vector<Vec3> normals_W;  // one a node of the mesh, outwards; not unit: sum over faces, 0 inside
  Eigen::AlignedBox3d box;      // of the surface, in the world
  /// Of each node and other muscle: how far both may travel, from the start on, before they can come within reach.
  std::vector<std::vector<double>> clear_until_m;
  std::vector<std::vector<int>> last_triangles;  // likewise: that were nearest, or -1; the next ones are no farther
  double travelled_m = 0.0;                      // sum of the largest ways of a node from one search to the next
  Eigen::VectorXd searched_at_m;                 // node positions of the last search
  std::vector<Found> found;                      // by the last search
  std::vector<FasciaBond> bonds;
  std::vector<int> held_by;              // of each node: the muscle that fascia holds it at, or -1
  std::vector<std::vector<int>> around;  // of each node of the mesh: triangles that it is a corner of
};

/// Surfaces of all muscles that are not rigid, at the file pose, with the depths that count as touching. One a muscle;
/// null pointers (rigid muscles) get an empty one. The normals and trees are those of the file pose.
std::vector<TouchSurface> make_touch_surfaces(const std::vector<MuscleTissue*>& tissues);

/// Nodal positions as points (Vec3 is three packed doubles): a view that lives as long as `values`.
std::span<const Vec3> as_points(const Eigen::VectorXd& values);

/// The largest way of a node since the last search. Positions: 3 numbers a node of the mesh.
double farthest_way_m(const Eigen::VectorXd& position_m, const TouchSurface& surface);

/// Brings tree, box and normals to these positions and adds to the way travelled.
void follow(const Eigen::VectorXd& position_m, TouchSurface& surface);

/// The place on a triangle as a touched face; its node and other are not set. The normal rotates smoothly from one flat
/// triangle to the next. Triangle -1 in a fold, where no side is outside.
TouchSurface::Found face_at(const TouchSurface& other, const geometry::SurfacePlace& place);

/// What lies under a point.
struct Under {
  TouchSurface::Found face;                                    // its node and other are not set
  geometry::SurfacePlace place;                                // of it
  double distance_m = 0.0;                                     // along the normal, < 0 inside
  double nearest_m = std::numeric_limits<double>::infinity();  // distance of the face, no sign
};

/// The face of `other` nearest to p, within the radius; face.triangle -1 when none is, or when p lies outside of a
/// surface whose smooth normal says inside, as beside a sharp rim. `positions_m`: one a node, those that `other`
/// followed last. Const: may be called from several threads.
Under face_under(const Vec3& p, const TouchSurface& other, std::span<const Vec3> positions_m, double radius_m);

}  // namespace myotact::simulation
