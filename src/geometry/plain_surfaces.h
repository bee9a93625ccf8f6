#pragma once

#include "core/vector.h"
#include "geometry/triangle_mesh.h"

namespace myotact::geometry {

// Surfaces that things are measured and tested on. Metres; triangles face outward.

/// Square of `cells` x `cells` cells in the plane z = 0, centred, normal +z. Open.
TriangleMesh make_plane(double side_m, int cells);
/// Closed box, centred, every side of `cells` x `cells` cells. A thin one is a sheet.
TriangleMesh make_box(const Vec3& size_m, int cells);
/// Two planes that meet in the y axis and rise to z = `depth_m` with this angle between them; solid below. Open.
TriangleMesh make_groove(double opening_rad, double depth_m, int cells);
/// Subdivided icosahedron: 20 x 4^levels triangles.
TriangleMesh make_ball(double radius_m, int levels);

/// Every triangle cut into four at the middles of its edges, `times` times: as fine as wanted, the shape unchanged.
TriangleMesh refined(const TriangleMesh& mesh, int times);

}  // namespace myotact::geometry
