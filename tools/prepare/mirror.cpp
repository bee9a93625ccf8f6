#include "prepare/mirror.h"

#include <utility>

namespace myotact::prepare {

namespace {

void flip(Vec3& p) {
  p.y() = -p.y();
}

void flip(geometry::TriangleMesh& mesh) {
  for (Vec3& p : mesh.positions_m) flip(p);
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
}

/// Linear tets only: what preparation makes.
void flip(geometry::TetMesh& mesh) {
  for (Vec3& p : mesh.nodes_m) flip(p);
  for (auto& corners : mesh.corners) std::swap(corners[0], corners[1]);
}

}  // namespace

anatomy::Specimen mirrored(anatomy::Specimen specimen) {
  specimen.side = specimen.side == "left" ? "right" : "left";
  for (anatomy::Bone& bone : specimen.bones) flip(bone.surface);
  for (anatomy::Body& body : specimen.bodies) {
    flip(body.com_m);
    body.inertia_kg_m2[3] = -body.inertia_kg_m2[3];  // xy
    body.inertia_kg_m2[5] = -body.inertia_kg_m2[5];  // yz
  }
  for (anatomy::Joint& joint : specimen.joints) {
    flip(joint.centre_m);
    for (Vec3& axis : joint.axes) axis = Vec3(-axis.x(), axis.y(), -axis.z());  // axial: the sense of rotation stays
  }
  for (anatomy::Muscle& muscle : specimen.muscles) {
    flip(muscle.tets);
    flip(muscle.skin);
    for (Vec3& fibre : muscle.fibres) flip(fibre);
  }
  for (anatomy::MuscleLine& line : specimen.lines) {
    for (anatomy::LinePoint& point : line.points) flip(point.position_m);
    for (anatomy::LineWrap& wrap : line.wraps) {
      flip(wrap.centre_m);
      flip(wrap.side);
      wrap.axes.col(1) = -wrap.axes.col(1);  // directions of a surface that is its own mirror image
    }
  }
  return specimen;
}

}  // namespace myotact::prepare
