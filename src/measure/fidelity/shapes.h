#pragma once

#include <string>
#include <vector>

#include "core/vector.h"
#include "geometry/triangle_mesh.h"

namespace myotact::measure {

// Surfaces that goals are measured on, beside the plain ones of geometry/plain_surfaces.h. Metres; triangles face
// outward.

/// How a ball swells and ripples: its radius follows a triangle wave of this amplitude and speed.
struct Swelling {
  double amplitude_m = 5e-3;
  double speed_m_s = 0.1;
  double phase = 0.0;      // in cycles
  double bump_m = 1.5e-3;  // height of the ripples, 20 mm apart on a ball of 25 mm, which move over the surface
};
/// The ball's vertices at a time, into `positions_m` of the same length.
void swell(const geometry::TriangleMesh& ball, const Swelling& swelling, double time_s, std::vector<Vec3>& positions_m);

/// A shape with a name for tables.
struct NamedShape {
  std::string name;
  geometry::TriangleMesh mesh;
};
/// The canine biceps brachii and gastrocnemius of MYOTACT_CANINE_DIR; empty where that is not there.
std::vector<NamedShape> canine_shapes();

}  // namespace myotact::measure
