#include "haptics/effects/relief.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace myotact::haptics {

namespace {

/// 1 below two thirds of the cap, 0 from the cap on, a cosine between.
double fade(double passing_Hz, double cap_Hz) {
  const double share = std::clamp(3.0 * passing_Hz / cap_Hz - 2.0, 0.0, 1.0);
  return 0.5 + 0.5 * std::cos(std::numbers::pi * share);
}

}  // namespace

ReliefPoint relief_at(std::span<const ReliefWave> waves, const Eigen::Vector2d& place_m,
                      const Eigen::Vector2d& velocity_m_s, double dt_s) noexcept {
  const double cap_Hz = std::min(kTextureCap_Hz, 0.3 / dt_s);
  ReliefPoint point;
  for (const ReliefWave& wave : waves) {
    const double number_rad_m = 2.0 * std::numbers::pi / wave.wavelength_m;
    const Eigen::Vector2d way(std::cos(wave.angle_rad), std::sin(wave.angle_rad));
    const double height_m = wave.height_m * fade(std::abs(way.dot(velocity_m_s)) / wave.wavelength_m, cap_Hz);
    const double phase_rad = number_rad_m * way.dot(place_m) + wave.phase_rad;
    point.height_m += height_m * std::cos(phase_rad);
    point.slope -= height_m * number_rad_m * std::sin(phase_rad) * way;
    point.amplitude_m += height_m;
    point.curvature_1_m += height_m * number_rad_m * number_rad_m;
  }
  return point;
}

}  // namespace myotact::haptics
