#pragma once

#include "geometry/tet_mesh.h"

namespace myotact::measure {

/// A quarter of a square block that is pressed in the middle of its top: the other three are its mirror images in x = 0
/// and y = 0.
struct IndentedBlock {
  double width_m = 0.0, thickness_m = 0.0;  // of the whole block
  int cells = 4;                            // from the middle to the edge of contact
};

/// Linear tets of that quarter, 0 <= x, y <= width/2, top at z = thickness, fine about the contact: the lines of the
/// mesh at a distance from the middle are circles up to `contact_m` and become squares towards the sides, so that the
/// edge of contact is one of them. 0 < contact_m < width/2.
geometry::TetMesh indented_mesh(const IndentedBlock& block, double contact_m);

/// Whether a node of the mesh is pressed: on the top, at most `contact_m` from the middle.
bool is_pressed(const Vec3& node_m, const IndentedBlock& block, double contact_m);

}  // namespace myotact::measure
