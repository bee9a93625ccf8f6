#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/vector.h"

namespace myotact::measure {

/// The force commanded of a device beside the one that it should have given, one entry a tick of 1 ms. Both on
/// the hand, in the world frame.
struct ForceSeries {
  std::vector<Vec3> commanded_N, true_N;  // same length
  std::vector<Vec3> hand_m;               // same length, or empty: work is not asked for
  std::vector<bool> compared;             // same length, or empty: every tick
};

/// Less force than this moves no device (coulomb friction of a desktop stylus, 0.05-0.3 N, lies above it): ticks
/// farther than kNearTouch_s from a true force that is larger are not looked at.
inline constexpr double kFeltForce_N = 0.02;
inline constexpr double kNearTouch_s = 0.05;

/// How the commanded force differs from the true one. NaN where unknown.
///
///   commanded(t) = gain rotation true(t - lag) + noise(t)
///
/// gain, rotation and lag are fitted together by least squares over all ticks near touch.
struct ForceComparison {
  std::size_t ticks = 0;  // near touch and compared: what all figures but work are about
  double true_rms_N = 0.0, true_peak_N = 0.0;
  // Straight difference, nothing taken out.
  double error_rms_N = 0.0, error_worst_N = 0.0;
  double error_rms_share = 0.0, error_worst_share = 0.0;  // of true_rms_N, of true_peak_N
  // What it is made of.
  double gain = 0.0;
  double lag_s = 0.0;                // > 0: the commanded force is late
  Vec3 rotation_rad = Vec3::Zero();  // rotation vector in the world: the constant rotation from true to commanded
  double mean_angle_rad = 0.0;  // between the two, the lag taken out, where the true one is over a tenth of its peak
  double noise_rms_N = 0.0;     // of the vector, over 20 Hz, of what gain, rotation and lag do not explain
  std::vector<double> noise_N2_Hz;  // its power density, entry i at i * 1000 / 256 Hz; empty: no stretch long enough
  // Over the compared ticks.
  double commanded_work_J = 0.0, true_work_J = 0.0;  // on the hand

  double rotation_angle_rad() const { return rotation_rad.norm(); }
};

/// A rotation about an axis that no force of the series shows (that along which all of them lie) counts as zero. Lags
/// are looked for up to 100 ms either way.
ForceComparison compare_forces(const ForceSeries& series);

/// What a force of 1 kHz swings by over 20 Hz: root mean square beside its mean over 50 ms. 0 for fewer ticks than
/// that.
double swing_N(std::span<const Vec3> force_N);

/// `force` at a time between ticks, cubic through its four neighbours; held at both ends.
Vec3 force_at(const std::vector<Vec3>& force, double tick);

}  // namespace myotact::measure
