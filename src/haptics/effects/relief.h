#pragma once

#include <span>

#include <Eigen/Core>

#include "haptics/effects/texture_set.h"

namespace myotact::haptics {

/// The height of a tissue's relief h(u, v) under the tool, u along the fibres and v across them, and its slope.
struct ReliefPoint {
  double height_m = 0.0;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();  // dh/du, dh/dv
  double amplitude_m = 0.0;                         // bound of the height
  double curvature_1_m = 0.0;                       // bound of its second derivatives
};

/// Waves that pass under the tool faster than the loop can render fade out: whole up to two thirds of kTextureCap_Hz,
/// gone at it, or at 0.3 a tick when ticks are longer, so that no wave is shorter than 3.3 ways of a tick (the limit is
/// 2). Real-time safe.
ReliefPoint relief_at(std::span<const ReliefWave> waves, const Eigen::Vector2d& place_m,
                      const Eigen::Vector2d& velocity_m_s, double dt_s) noexcept;

}  // namespace myotact::haptics
