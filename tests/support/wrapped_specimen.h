#pragma once

#include "support/synthetic_specimen.h"

// Muscles that lie around a bone: what a wrapped muscle does at a joint has a closed form, K = sum r^2 k, because its
// moment arm stays.

namespace myotact::testing {

/// Closed cylinder of 96 sides about an axis along y through `centre_m`.
geometry::TriangleMesh cylinder_surface(const Vec3& centre_m, double radius_m, double length_m);

/// Tangent, arc, tangent: a flat bar that lies on a cylinder about the hinge and ends on both sides of it. Made at rest
/// in this shape. In the plane y = 0; `side` +1: over the joint (flexes), -1: under it (extends).
struct WrappedBar {
  double radius_m = 0.03;  // of the cylinder
  double half_arc_rad = 0.7;
  double straight_m = 0.03;    // each end
  double thickness_m = 0.004;  // thin against the radius: the pressure of a wrapped belly squeezes it sideways
  double width_m = 0.02;
  std::array<int, 3> cells{14, 2, 1};  // along, across, through
  double side = 1.0;

  /// Moment arm of the middle of its section.
  double moment_arm_m() const { return radius_m + 0.5 * thickness_m; }
  double length_m() const { return 2.0 * (half_arc_rad * moment_arm_m() + straight_m); }
};

/// hinged_bones() with one bone, the cylinder on the upper body, and one wrapped bar, or two mirror images of each
/// other as flexor and extensor. Fibres all of one length, along the bars; the passive joint has no stiffness.
anatomy::Specimen wrapped_hinge(const WrappedBar& bar, bool pair);

}  // namespace myotact::testing
