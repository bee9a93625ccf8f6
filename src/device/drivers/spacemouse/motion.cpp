#include "device/drivers/spacemouse/motion.h"

#include <algorithm>
#include <cmath>

namespace myotact::device::spacemouse {

namespace {

/// Reports come every 8 ms by cable and every 16 ms by radio: the steps become ramps.
constexpr double kLag_s = 0.02;
constexpr double kLongestGap_s = 0.02;

double shaped(double deflection, const MotionSettings& settings) {
  const double beyond = std::abs(deflection) - settings.dead_zone;
  if (beyond <= 0.0) return 0.0;
  const double share = std::min(1.0, beyond / (1.0 - settings.dead_zone));
  return std::copysign(std::pow(share, settings.curve_exponent), deflection);
}

}  // namespace

Vec3 shaped_push(const Cap& cap, const MotionSettings& settings) noexcept {
  const auto axis = [&](std::size_t raw) { return shaped(1.0 / kFullDeflection * cap.push[raw], settings); };
  return settings.axis_signs.cwiseProduct(Vec3(axis(0), -axis(2), axis(1)));
}

void Motion::advance(const Cap& cap, double dt_s) noexcept {
  const double dt = std::clamp(dt_s, 0.0, kLongestGap_s);
  const double follows = 1.0 - std::exp(-dt / kLag_s);
  const Vec3 push = shaped_push(cap, settings_);
  if (settings_.mode == MotionMode::Rate) {
    follow_rate(push, follows, dt);
  } else {
    follow_position(push, follows);
  }
}

void Motion::follow_rate(const Vec3& push, double follows, double dt_s) noexcept {
  velocity_m_s_ += follows * (settings_.full_speed_m_s * push - velocity_m_s_);
  const Vec3 wanted_m = position_m_ + dt_s * velocity_m_s_;
  const double edge_m = settings_.half_workspace_m;
  position_m_ = wanted_m.cwiseMax(-edge_m).cwiseMin(edge_m);
  for (int axis = 0; axis < 3; ++axis) {
    if (position_m_[axis] != wanted_m[axis]) velocity_m_s_[axis] = 0.0;
  }
}

void Motion::follow_position(const Vec3& push, double follows) noexcept {
  const Vec3 target_m = settings_.full_offset_m * push;
  position_m_ += follows * (target_m - position_m_);
  velocity_m_s_ = (target_m - position_m_) / kLag_s;
}

void Motion::halt() noexcept {
  velocity_m_s_.setZero();
}

}  // namespace myotact::device::spacemouse
