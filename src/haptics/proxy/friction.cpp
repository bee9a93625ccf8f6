#include "haptics/proxy/friction.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace myotact::haptics {

namespace {

/// Slower than this for so long, and the contact sticks again (own choice). At 1 mm/s it slips 1 um a tick: below
/// the resolution of every device's encoder (10-55 um).
constexpr double kSticks_m_s = 1e-3;
constexpr int kStickingTicks = 3;
/// Friction follows speed with this lag. Lubricated contacts show 1-50 ms (frictional memory: Armstrong-Helouvry
/// et al. 1994); it spreads the fall from static to dynamic over a few ticks, and the noise of a
/// velocity that is measured by an encoder.
constexpr double kMemory_s = 5e-3;
/// Fibres that stand on the surface steeper than this (sine) have no direction along it.
constexpr double kFlattest = 0.05;

/// Unit vectors in the plane of the contact, the first along the fibres; none: false.
bool fibre_axes(const FrictionTrial& trial, Vec3& along, Vec3& across) {
  const Vec3 in_plane = trial.fibre - trial.fibre.dot(trial.normal) * trial.normal;
  const double length = in_plane.norm();
  if (!(length > kFlattest * trial.fibre.norm()) || !(length > 0.0)) return false;
  along = in_plane / length;
  across = trial.normal.cross(along);
  return true;
}

}  // namespace

Eigen::Vector2d nearest_in_ellipse(const Eigen::Vector2d& point, const Eigen::Vector2d& half_axes) noexcept {
  const Eigen::Array2d squared = half_axes.array().square();
  if (!(half_axes.minCoeff() > 0.0)) return Eigen::Vector2d::Zero();
  if ((point.array() / half_axes.array()).square().sum() <= 1.0) return point;
  // The nearest point is squared / (squared + t) * point. Newton for the t that puts it on the rim, by the inverse of
  // its radius, which is nearly straight in t (exactly for a circle), concave, and so never overshoots.
  double t = 0.0;
  Eigen::Array2d scaled;
  for (int iteration = 0; iteration < 12; ++iteration) {
    scaled = point.array() * half_axes.array() / (squared + t);
    const double radius = std::sqrt(scaled.square().sum());
    const double slope = (scaled.square() / (squared + t)).sum() / radius;
    const double step = (radius - 1.0) * radius / slope;
    t += step;
    if (!(step > 1e-13 * squared.maxCoeff())) break;
  }
  scaled = point.array() * half_axes.array() / (squared + t);
  scaled /= std::sqrt(scaled.square().sum());
  return (scaled * half_axes.array()).matrix();
}

double Friction::coefficient() const noexcept {
  const double ratio = sliding_ ? speed_m_s_ / settings_.stribeck_m_s : 0.0;
  return settings_.dynamic_friction +
         (settings_.static_friction - settings_.dynamic_friction) * std::exp(-ratio * ratio);
}

Vec3 Friction::slip_m(const FrictionTrial& trial) const noexcept {
  const double viscous = settings_.viscous_Ns_m / (trial.stiffness_N_m * trial.dt_s);
  const Vec3 pull_m = trial.lag_m - viscous * trial.slipped_m;
  const double across_m = coefficient() * trial.depth_m;
  Vec3 along, across;
  Vec3 held_m = pull_m;
  if (settings_.along_over_across != 1.0 && fibre_axes(trial, along, across)) {
    const Eigen::Vector2d held =
        nearest_in_ellipse({pull_m.dot(along), pull_m.dot(across)}, {settings_.along_over_across * across_m, across_m});
    held_m = held.x() * along + held.y() * across;
  } else {
    const double length_m = pull_m.norm();
    if (length_m > across_m) held_m *= across_m / length_m;
  }
  return (pull_m - held_m) / (1.0 + viscous);
}

void Friction::settle(double slipped_m, double tool_speed_m_s, double dt_s) noexcept {
  const bool slow = slipped_m < kSticks_m_s * dt_s;
  if (!sliding_) {
    sliding_ = !slow;
    speed_m_s_ = 0.0;
    slow_ticks_ = 0;
    return;
  }
  slow_ticks_ = slow ? slow_ticks_ + 1 : 0;
  if (slow_ticks_ >= kStickingTicks) {
    release();
    return;
  }
  speed_m_s_ += (tool_speed_m_s - speed_m_s_) * (1.0 - std::exp(-dt_s / kMemory_s));
}

void Friction::release() noexcept {
  sliding_ = false;
  speed_m_s_ = 0.0;
  slow_ticks_ = 0;
}

}  // namespace myotact::haptics
