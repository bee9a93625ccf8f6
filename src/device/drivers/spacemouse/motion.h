#pragma once

#include <cstdint>

#include "core/vector.h"
#include "device/drivers/spacemouse/reports.h"

namespace myotact::device::spacemouse {

/// Rate: a pushed cap moves the tool, at rest the tool stays where it is. Position: the tool is as far from the middle
/// as the cap is pushed, and comes back with it.
enum class MotionMode : std::uint8_t { Rate, Position };

/// How a push of the cap becomes motion of a tool. Numbers without another source are ours: what moves a tool about one
/// body part slowly enough to press with it.
struct MotionSettings {
  MotionMode mode = MotionMode::Rate;
  double dead_zone = 0.05;  // of full deflection, 0 .. 0.9: a resting hand moves nothing
  /// Above the dead zone: output = share^exponent, the share being 0 at its edge and 1 at full deflection. 1: straight;
  /// 2: fine motion near rest.
  double curve_exponent = 2.0;
  double full_speed_m_s = 0.12;   // Rate, at full deflection
  double full_offset_m = 0.05;    // Position, at full deflection
  double half_workspace_m = 0.1;  // Rate: the tool stays in a cube this far about the middle
  /// 1 or -1 for right, up and towards the person. The raw axes are derived from drivers of others, not from the
  /// maker's sheet (uncertain): reverse an axis here if a model differs.
  Vec3 axis_signs = Vec3::Ones();
};

/// Push of the cap, each axis by the dead zone and the curve: -1 .. 1 to the right, up and towards the person.
Vec3 shaped_push(const Cap& cap, const MotionSettings& settings) noexcept;

/// A tool moved by a cap, in the device's frame: x right, y up, z towards the person [m] from the middle. Allocates
/// nothing.
class Motion {
 public:
  explicit Motion(const MotionSettings& settings) : settings_(settings) {}

  /// `dt_s` later, 0 to 0.02 s: a longer pause (a stopped process) moves the tool no farther.
  void advance(const Cap& cap, double dt_s) noexcept;
  /// At once, where it is: the cap is gone.
  void halt() noexcept;

  const Vec3& position_m() const { return position_m_; }
  const Vec3& velocity_m_s() const { return velocity_m_s_; }

 private:
  void follow_rate(const Vec3& push, double follows, double dt_s) noexcept;
  void follow_position(const Vec3& push, double follows) noexcept;

  MotionSettings settings_;
  Vec3 position_m_ = Vec3::Zero();
  Vec3 velocity_m_s_ = Vec3::Zero();
};

}  // namespace myotact::device::spacemouse
