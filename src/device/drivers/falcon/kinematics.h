#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/vector.h"

namespace myotact::device::falcon {

// The Falcon's three legs, each a driven arm in a vertical plane with a parallelogram (Stamper's thesis names the
// parts). Frame: x right, y up, z out of the device towards the person, origin in the plane of the arms' axes; the grip
// is at about 0.075 (in) .. 0.175 m (out). Angles: of the arms above the radial direction, top, right, left leg.
// Real-time safe.

using Angles = std::array<double, 3>;  // [rad]

/// Closed form; nothing: out of reach of a leg.
std::optional<Angles> angles_of(const Vec3& grip_m) noexcept;

/// By Newton's method from the middle of the workspace; nothing: the legs do not meet within 20 steps. Angles far
/// outside the workspace may end where legs are folded the other way: angles_of() then gives others.
std::optional<Vec3> grip_of(const Angles& angles_rad) noexcept;

/// d angles / d grip [rad/m], by the implicit function of each leg's closure; nothing: a leg is stretched or folded so
/// far that a row is not finite. Close to that it is large.
std::optional<Mat3> angles_per_metre(const Vec3& grip_m, const Angles& angles_rad) noexcept;

/// Torque of the arms [N m] that makes the force at the grip: J^T tau = F with J = d angles / d grip. Nothing: it
/// is not finite.
std::optional<Vec3> torque_of(const Vec3& force_N, const Mat3& angles_per_metre) noexcept;

/// An arm's angle by its encoder's count after homing [rad].
double angle_of_counts(double counts) noexcept;
double counts_of_angle(double angle_rad) noexcept;

/// Torque as motor counts by `counts_per_Nm`; all three are scaled by one factor where the largest would exceed what a
/// motor takes, so that the force keeps its direction. Not a number: zero.
std::array<std::int16_t, 3> motor_counts(const Vec3& torque_Nm, double counts_per_Nm) noexcept;

}  // namespace myotact::device::falcon
