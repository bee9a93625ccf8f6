#pragma once

namespace myotact::measure {

/// A muscle's way past a hinge, in the plane across its axis: a constant part, then a segment from P on the proximal to
/// D on the distal bone, straight or over a cylinder about the axis. `offset_m` is how far P and D lie apart along the
/// axis. Seen from the hinge, P and D are phi = phi0 + sign q apart on the muscle's side.
struct WrappedPath {
  double constant_m = 0.0;
  double a_m = 0.0, b_m = 0.0;  // P and D from the axis
  double phi0_rad = 0.0;
  double sign = 1.0;  // +1: flexion opens phi and lengthens the muscle (an extensor); -1: closes it (a flexor)
  double offset_m = 0.0;
  double radius_m = 0.0;  // of the cylinder, at most the smaller of a and b; 0: none
};

/// A path at one angle. Exact; the arm's slope jumps where the path begins to wrap, where it is the straight side's.
struct PathGeometry {
  double length_m = 0.0;
  double arm_m = 0.0;            // r = -dL/dq, positive flexes
  double arm_slope_m_rad = 0.0;  // dr/dq
};

/// phi must not be a multiple of 2 pi when a = b and the offset is 0: P and D would coincide.
PathGeometry measure_path(const WrappedPath& path, double q_rad) noexcept;

}  // namespace myotact::measure
