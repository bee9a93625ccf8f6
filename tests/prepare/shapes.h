#pragma once

#include "geometry/triangle_mesh.h"
#include "prepare/architecture/attachment_patch.h"
#include "prepare/recipe/anatomy_data.h"
#include "prepare/recipe/named_surface.h"

// Closed surfaces with known volume, and a small limb made of them.

namespace myotact::testing {

/// Axis-aligned box of 12 triangles, outward.
geometry::TriangleMesh box_surface(const Vec3& lowest_m, const Vec3& highest_m);

/// A prism with `sides` sides about the x axis, from x = 0 to `length_m`, `rings` steps along it, outward. Its section
/// is sides/2 radius^2 sin(2 pi/sides).
struct RodShape {
  double radius_m = 0.012;
  double length_m = 0.10;
  int sides = 12;
  int rings = 12;
};
geometry::TriangleMesh rod_surface(const RodShape& shape);
double rod_section_m2(const RodShape& shape);

/// A sheet in the x-y plane, bulged upward by a paraboloid, outward.
struct SheetShape {
  double length_m = 0.08, width_m = 0.06, thickness_m = 0.002;
  double bulge_m = 0.0;
  int steps = 24;  // along each side
};
geometry::TriangleMesh sheet_surface(const SheetShape& shape);

/// An icosahedron whose edges were halved so often, on a sphere, outward: 20 4^halvings triangles.
geometry::TriangleMesh sphere_surface(const Vec3& centre_m, double radius_m, int halvings);

/// The flat end of the rod at x = 0 or at x = length.
prepare::AttachmentPatch rod_end(const geometry::TriangleMesh& rod, double x_m);

/// Two bodies with a box bone each, joined by a hinge about -y at (0.05, 0, -0.02), and the rod as a muscle from the
/// first to the second along x.
struct SmallLimb {
  prepare::AnatomyData anatomy;
  std::vector<prepare::NamedSurface> bones, muscles;
};
SmallLimb small_limb();

}  // namespace myotact::testing
