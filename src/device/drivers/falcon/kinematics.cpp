#include "device/drivers/falcon/kinematics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/LU>

#include "device/drivers/falcon/packet.h"

namespace myotact::device::falcon {

namespace {

// Lengths [m] as libnifalcon gives them: measured by its users, not the maker's; good to about a millimetre.
constexpr double kArm = 0.060;                       // a: axis to knee
constexpr double kSide = 0.1025;                     // b: of the parallelogram
constexpr double kGripRadial = 0.01443;              // c: shin's joint to the middle of the grip
constexpr double kJointOffsets = 0.01125 + 0.01125;  // d + e: at both ends of the shin
constexpr double kGripSideways = -0.025;             // f
constexpr double kAxisRadial = 0.0400;               // r: origin to the arm's axis
constexpr double kAxisSideways = -0.02309;           // s
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::array<double, 3> kAzimuth_rad = {105.0 * kDegree, -15.0 * kDegree, -135.0 * kDegree};

constexpr double kCountsPerTurn = 320.0 * 4.0;  // slots of the encoder, four edges each
constexpr double kGear = 0.110 / 0.01425;       // drum of the arm over the motor's shaft
constexpr double kRadPerCount = 2.0 * std::numbers::pi / (kCountsPerTurn * kGear);
constexpr double kAngleAtZero_rad = 35.0 * kDegree;  // of the arms where homing sets the count to zero; within a degree

constexpr double kStart_m = 0.125;    // on the axis, the middle of the workspace: all poses are reached from there
constexpr int kMostSteps = 20;        // six are enough for every pose in reach
constexpr double kClosed_m2 = 1e-16;  // of the closure: about 1e-15 m at the grip

/// Where the grip is, seen from a leg: outwards, sideways and along the device's axis, from the arm's axis.
struct LegView {
  double outwards, sideways, axial;
};

LegView seen_from(const Vec3& grip_m, double azimuth_rad) {
  const double c = std::cos(azimuth_rad), s = std::sin(azimuth_rad);
  return {grip_m.x() * c + grip_m.y() * s - kAxisRadial + kGripRadial,
          -grip_m.x() * s + grip_m.y() * c - kAxisSideways + kGripSideways, grip_m.z()};
}

/// How long the shin is, seen in the leg's plane; not a number: the parallelogram does not reach that far aside.
struct Shin {
  double lean, length;
};

Shin shin_of(const LegView& view) {
  const double lean = std::sqrt(kSide * kSide - view.sideways * view.sideways);
  return {lean, kJointOffsets + lean};
}

/// Of a leg's closure g = |grip - knee|^2 - length^2 in its plane: its value and its slopes.
struct Closure {
  double value, by_angle;
  Vec3 by_grip;
};

Closure closure_of(const Vec3& grip_m, double angle_rad, double azimuth_rad) {
  const LegView view = seen_from(grip_m, azimuth_rad);
  const Shin shin = shin_of(view);
  const double x = view.outwards - kArm * std::cos(angle_rad), z = view.axial - kArm * std::sin(angle_rad);
  const double by_outwards = 2.0 * x, by_sideways = 2.0 * shin.length * view.sideways / shin.lean;
  const double c = std::cos(azimuth_rad), s = std::sin(azimuth_rad);
  return {x * x + z * z - shin.length * shin.length,
          2.0 * kArm * (x * std::sin(angle_rad) - z * std::cos(angle_rad)),
          {by_outwards * c - by_sideways * s, by_outwards * s + by_sideways * c, 2.0 * z}};
}

std::optional<double> angle_of_leg(const LegView& view) {
  const double length = shin_of(view).length, reach = std::hypot(view.outwards, view.axial);
  const double cosine = (reach * reach + kArm * kArm - length * length) / (2.0 * kArm * reach);
  if (!(std::abs(cosine) <= 1.0)) return std::nullopt;
  return std::atan2(view.axial, view.outwards) - std::acos(cosine);
}

}  // namespace

std::optional<Angles> angles_of(const Vec3& grip_m) noexcept {
  Angles angles_rad{};
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const auto angle_rad = angle_of_leg(seen_from(grip_m, kAzimuth_rad[leg]));
    if (!angle_rad) return std::nullopt;
    angles_rad[leg] = *angle_rad;
  }
  return angles_rad;
}

std::optional<Vec3> grip_of(const Angles& angles_rad) noexcept {
  Vec3 grip_m(0.0, 0.0, kStart_m);
  for (int step = 0; step < kMostSteps; ++step) {
    Vec3 value;
    Mat3 slope;
    for (std::size_t leg = 0; leg < 3; ++leg) {
      const Closure closure = closure_of(grip_m, angles_rad[leg], kAzimuth_rad[leg]);
      value[static_cast<int>(leg)] = closure.value;
      slope.row(static_cast<int>(leg)) = closure.by_grip;
    }
    if (!value.allFinite() || !slope.allFinite()) return std::nullopt;
    if (value.cwiseAbs().maxCoeff() < kClosed_m2) return grip_m;
    grip_m -= slope.partialPivLu().solve(value);
  }
  return std::nullopt;
}

std::optional<Mat3> angles_per_metre(const Vec3& grip_m, const Angles& angles_rad) noexcept {
  Mat3 slope;
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const Closure closure = closure_of(grip_m, angles_rad[leg], kAzimuth_rad[leg]);
    slope.row(static_cast<int>(leg)) = -closure.by_grip / closure.by_angle;
  }
  if (!slope.allFinite()) return std::nullopt;
  return slope;
}

std::optional<Vec3> torque_of(const Vec3& force_N, const Mat3& angles_per_metre) noexcept {
  const Vec3 torque_Nm = angles_per_metre.transpose().partialPivLu().solve(force_N);
  if (!torque_Nm.allFinite()) return std::nullopt;
  return torque_Nm;
}

double angle_of_counts(double counts) noexcept {
  return kAngleAtZero_rad + kRadPerCount * counts;
}

double counts_of_angle(double angle_rad) noexcept {
  return (angle_rad - kAngleAtZero_rad) / kRadPerCount;
}

std::array<std::int16_t, 3> motor_counts(const Vec3& torque_Nm, double counts_per_Nm) noexcept {
  const Vec3 wanted = -counts_per_Nm * torque_Nm;  // a motor that rotates its arm outwards counts down
  if (!wanted.allFinite()) return {};
  const double scale = std::min(1.0, kMostCounts / std::max(wanted.cwiseAbs().maxCoeff(), 1.0));
  std::array<std::int16_t, 3> counts{};
  for (std::size_t leg = 0; leg < 3; ++leg)
    counts[leg] = static_cast<std::int16_t>(std::lround(scale * wanted[static_cast<int>(leg)]));
  return counts;
}

}  // namespace myotact::device::falcon
