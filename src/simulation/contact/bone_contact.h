#pragma once

#include <memory>
#include <vector>

#include "anatomy/specimen.h"
#include "geometry/distance_field.h"
#include "geometry/tet_mesh.h"

namespace myotact::simulation {

/// A bone as muscles touch it: signed distance in the specimen's frame at the file pose.
struct BoneShape {
  int body = -1;                  // that carries it
  geometry::DistanceField field;  // < 0 inside
};
using BoneShapes = std::vector<BoneShape>;  // of a specimen; read only, may be shared by threads

/// A node of a muscle's surface with the part of the surface that it carries.
struct SurfaceNode {
  int node = -1;         // of the muscle's mesh
  double area_m2 = 0.0;  // at rest
};

/// What of a muscle can touch one bone.
struct BonePatch {
  /// A node that may touch the bone.
  struct Node {
    int node = -1;
    double area_m2 = 0.0;
    double rest_depth_m = 0.0;  // >= 0: how deep it lies at the file pose, which counts as touching
  };
  int bone = -1;            // of the shapes
  std::vector<Node> nodes;  // free ones
};

/// Frictionless contact of a muscle's surface nodes with bones. Empty: none.
///
/// Energy of a node: area times the law's over the overlap s = -d(y) - rest_depth, y the node in the bone's frame, d
/// the bone's signed distance. The joints enter through y, so forces, torques and their tangents follow from one
/// energy.
struct BoneContact {
  std::shared_ptr<const BoneShapes> bones;  // shared by all muscles
  std::vector<BonePatch> patches;           // one a bone that the muscle may touch
};

/// Distance fields of all bones with a surface, in the specimen's order. Takes a while.
std::shared_ptr<const BoneShapes> make_bone_shapes(const anatomy::Specimen& specimen);

/// Area of the boundary that falls to each node of it, faces that touch the attachment to `without_body` left out: a
/// quarter of each face to a mid-side node and a twelfth to a corner of a quadratic mesh (four triangles a face), a
/// third to a corner of a linear one. `attachment`: one a node, body or -1; `without_body` -1: all faces. Rest areas,
/// in rising order of the nodes.
std::vector<SurfaceNode> surface_nodes(const geometry::TetMesh& mesh, const std::vector<int>& attachment,
                                       int without_body);

/// Free surface nodes of a muscle against every bone; next to its attachment on a body a muscle does not touch that
/// body's bones. `attachment`: one a node, body or -1.
BoneContact make_bone_contact(std::shared_ptr<const BoneShapes> bones, const geometry::TetMesh& mesh,
                              const std::vector<int>& attachment);

}  // namespace myotact::simulation
