#pragma once

#include <string>
#include <vector>

#include "core/vector.h"
#include "geometry/triangle_mesh.h"

namespace myotact::measure {

// Surfaces that goals are measured on. Metres; triangles face outward.

/// Square of `cells` x `cells` cells in the plane z = 0, centred, normal +z. Open.
geometry::TriangleMesh make_plane(double side_m, int cells);
/// Closed box, centred, every side of `cells` x `cells` cells. A thin one is a sheet.
geometry::TriangleMesh make_box(const Vec3& size_m, int cells);
/// Two planes that meet in the y axis and rise to z = `depth_m` with this angle between them; solid below. Open.
geometry::TriangleMesh make_groove(double opening_rad, double depth_m, int cells);
/// Subdivided icosahedron: 20 x 4^levels triangles.
geometry::TriangleMesh make_ball(double radius_m, int levels);

/// How a ball swells and ripples: its radius follows a triangle wave of this amplitude and speed.
struct Swelling {
  double amplitude_m = 5e-3;
  double speed_m_s = 0.1;
  double phase = 0.0;      // in cycles
  double bump_m = 1.5e-3;  // height of the ripples, 20 mm apart on a ball of 25 mm, which move over the surface
};
/// The ball's vertices at a time, into `positions_m` of the same length.
void swell(const geometry::TriangleMesh& ball, const Swelling& swelling, double time_s, std::vector<Vec3>& positions_m);

/// Every triangle cut into four at the middles of its edges, `times` times: as fine as wanted, the shape unchanged.
geometry::TriangleMesh refined(const geometry::TriangleMesh& mesh, int times);

/// A shape with a name for tables.
struct NamedShape {
  std::string name;
  geometry::TriangleMesh mesh;
};
/// The canine biceps brachii and gastrocnemius of MYOTACT_CANINE_DIR; empty where that is not there.
std::vector<NamedShape> canine_shapes();

/// How many times a closed surface winds round a point: 1 inside, 0 outside. Looks at every triangle.
double winding_number(const geometry::TriangleMesh& mesh, const std::vector<Vec3>& positions_m, const Vec3& p);

}  // namespace myotact::measure
