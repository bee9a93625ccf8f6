#include "measure/fidelity/force_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "measure/fidelity/spectrum.h"

namespace myotact::measure {

namespace {

constexpr double kRate_Hz = 1000.0;
constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();
constexpr int kLongestLag_ticks = 100;
constexpr std::size_t kFewest_ticks = 50;  // below, gain, rotation and lag together fit anything
/// A rotation about an axis is seen by what the forces have across it: less than this share of the best seen axis (that
/// is, forces within 3 degrees of the axis) does not determine it.
constexpr double kSeen_share = 3e-3;
constexpr double kNoiseAbove_Hz = 20.0;  // as the goal of a press at rest has it: below lies what hands and tissue do

/// Ticks that count: compared, and near a true force that is felt.
std::vector<bool> near_touch(const ForceSeries& series) {
  const std::size_t ticks = series.true_N.size();
  const auto reach = static_cast<std::size_t>(std::lround(kNearTouch_s * kRate_Hz));
  std::vector<bool> near(ticks, false);
  std::size_t marked = 0;  // all before are decided
  for (std::size_t i = 0; i < ticks; ++i) {
    if (!(series.true_N[i].norm() > kFeltForce_N)) continue;
    const std::size_t last = std::min(ticks, i + reach + 1);
    for (std::size_t k = std::max(marked, i > reach ? i - reach : 0); k < last; ++k) near[k] = true;
    marked = last;
  }
  for (std::size_t i = 0; i < ticks; ++i)
    near[i] = near[i] && (series.compared.empty() || series.compared[i]) && series.commanded_N[i].allFinite();
  return near;
}

/// Sums over the ticks of a lag, from which the best gain and rotation follow.
struct Moments {
  Mat3 product = Mat3::Zero();  // sum commanded true^T
  Mat3 truth = Mat3::Zero();    // sum true true^T
};

struct Fit {
  double gain = 0.0;
  Mat3 rotation = Mat3::Identity();
  double explained_N2 = 0.0;  // of the sum of the commanded force's squares
};

Vec3 rotation_vector(const Mat3& rotation) {
  const Eigen::AngleAxisd angle_axis(rotation);
  return angle_axis.angle() * angle_axis.axis();
}

/// The step of the rotation that the moments ask for, seen axes only.
Vec3 rotation_step(const Moments& sums, const Mat3& rotation, double gain) {
  const Mat3 rotated = sums.product * rotation.transpose();
  const Vec3 wanted(rotated(2, 1) - rotated(1, 2), rotated(0, 2) - rotated(2, 0), rotated(1, 0) - rotated(0, 1));
  const Mat3 across = sums.truth.trace() * Mat3::Identity() - rotation * sums.truth * rotation.transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(across);
  Vec3 step = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    if (axes.eigenvalues()[k] < kSeen_share * axes.eigenvalues()[2]) continue;
    const Vec3 axis = axes.eigenvectors().col(k);
    step += axis.dot(wanted) / (gain * axes.eigenvalues()[k]) * axis;
  }
  return step;
}

/// Least squares of commanded - gain rotation true (Gauss and Newton's steps for the rotation; they end within four).
Fit fit_gain_and_rotation(const Moments& sums) {
  Fit fit;
  const double truth_N2 = sums.truth.trace();
  if (!(truth_N2 > 0.0)) return fit;
  for (int iteration = 0; iteration < 8; ++iteration) {
    fit.gain = (fit.rotation.transpose() * sums.product).trace() / truth_N2;
    if (!(fit.gain > 0.0)) break;  // the two have nothing to do with each other at this lag
    const Vec3 step = rotation_step(sums, fit.rotation, fit.gain);
    if (step.norm() < 1e-12) break;
    fit.rotation = Eigen::AngleAxisd(std::min(step.norm(), 1.0), step.normalized()).toRotationMatrix() * fit.rotation;
  }
  fit.gain = (fit.rotation.transpose() * sums.product).trace() / truth_N2;
  fit.explained_N2 = fit.gain > 0.0 ? fit.gain * fit.gain * truth_N2 : 0.0;
  return fit;
}

Fit fit_at(const ForceSeries& series, const std::vector<bool>& used, double lag_ticks) {
  Moments sums;
  const bool whole = lag_ticks == std::floor(lag_ticks);
  const auto last = static_cast<long>(series.true_N.size()) - 1;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    const long at = std::clamp(static_cast<long>(i) - static_cast<long>(lag_ticks), 0L, last);
    const Vec3 true_N = whole ? series.true_N[static_cast<std::size_t>(at)]
                              : force_at(series.true_N, static_cast<double>(i) - lag_ticks);
    sums.product += series.commanded_N[i] * true_N.transpose();
    sums.truth += true_N * true_N.transpose();
  }
  return fit_gain_and_rotation(sums);
}

/// The lag that explains most, between whole ticks by the parabola through the three best: what is left over a smooth
/// force grows with the square of the lag's error.
double best_lag_ticks(const ForceSeries& series, const std::vector<bool>& used) {
  constexpr std::size_t kLags = 2 * kLongestLag_ticks + 1;
  std::array<double, kLags> explained{};
  for (std::size_t k = 0; k < kLags; ++k)
    explained[k] = fit_at(series, used, static_cast<double>(k) - kLongestLag_ticks).explained_N2;
  const auto best = static_cast<std::size_t>(std::max_element(explained.begin(), explained.end()) - explained.begin());
  const double whole = static_cast<double>(best) - kLongestLag_ticks;
  if (best == 0 || best + 1 == kLags) return whole;
  const double before = explained[best - 1], here = explained[best], after = explained[best + 1];
  const double bend = before - 2.0 * here + after;
  return bend < 0.0 ? whole + 0.5 * (before - after) / bend : whole;
}

/// Low pass at kNoiseAbove_Hz, a sinc under Hann's window, over the used neighbours only.
class SlowPart {
 public:
  SlowPart() {
    for (int k = -kHalf; k <= kHalf; ++k) {
      const double turns = kNoiseAbove_Hz / kRate_Hz * k;
      const double angle_rad = 2.0 * std::numbers::pi * turns;
      const double window = 0.5 + 0.5 * std::cos(std::numbers::pi * k / (kHalf + 1));
      weights_[index(k)] = window * (k == 0 ? 1.0 : std::sin(angle_rad) / angle_rad);
    }
  }
  Vec3 at(const std::vector<Vec3>& signal, const std::vector<bool>& used, std::size_t tick) const {
    Vec3 sum = Vec3::Zero();
    double weight = 0.0;
    for (int k = -kHalf; k <= kHalf; ++k) {
      const long other = static_cast<long>(tick) + k;
      if (other < 0 || other >= static_cast<long>(signal.size()) || !used[static_cast<std::size_t>(other)]) continue;
      const double share = weights_[index(k)];
      sum += share * signal[static_cast<std::size_t>(other)];
      weight += share;
    }
    return sum / weight;  // the tick itself has a share of 1
  }

 private:
  static std::size_t index(int k) {
    const int from_first = k + kHalf;
    return static_cast<std::size_t>(from_first);
  }

  static constexpr int kHalf = 75;  // passes 10 Hz, stops 30 Hz
  std::array<double, 2 * kHalf + 1> weights_{};
};

/// Mean power density of the used stretches that hold a segment, all three axes together.
std::vector<double> spectrum_of(const std::vector<Vec3>& signal, const std::vector<bool>& used) {
  std::vector<double> density;
  double ticks = 0.0;
  for (std::size_t start = 0; start < used.size();) {
    std::size_t end = start;
    while (end < used.size() && used[end]) ++end;
    const std::size_t length = end - start;
    if (length >= kSegment) {
      density.resize(kSegment / 2 + 1, 0.0);
      for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> samples;
        for (std::size_t i = start; i < end; ++i) samples.push_back(signal[i][axis]);
        const std::vector<double> here = power_spectrum(samples, kRate_Hz);
        for (std::size_t bin = 0; bin < here.size(); ++bin) density[bin] += static_cast<double>(length) * here[bin];
      }
      ticks += static_cast<double>(length);
    }
    start = end + 1;
  }
  for (double& value : density) value /= ticks;
  return density;
}

void measure_size_and_error(const ForceSeries& series, const std::vector<bool>& used, ForceComparison& result) {
  double true_N2 = 0.0, error_N2 = 0.0;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    ++result.ticks;
    const Vec3 error_N = series.commanded_N[i] - series.true_N[i];
    true_N2 += series.true_N[i].squaredNorm();
    error_N2 += error_N.squaredNorm();
    result.true_peak_N = std::max(result.true_peak_N, series.true_N[i].norm());
    result.error_worst_N = std::max(result.error_worst_N, error_N.norm());
  }
  const double ticks = std::max(1.0, static_cast<double>(result.ticks));
  result.true_rms_N = std::sqrt(true_N2 / ticks);
  result.error_rms_N = std::sqrt(error_N2 / ticks);
  result.error_rms_share = result.true_rms_N > 0.0 ? result.error_rms_N / result.true_rms_N : kNotKnown;
  result.error_worst_share = result.true_peak_N > 0.0 ? result.error_worst_N / result.true_peak_N : kNotKnown;
}

void measure_work(const ForceSeries& series, ForceComparison& result) {
  for (std::size_t i = 0; i + 1 < series.hand_m.size(); ++i) {
    if (!series.compared.empty() && !series.compared[i]) continue;
    const Vec3 way_m = series.hand_m[i + 1] - series.hand_m[i];
    result.commanded_work_J += series.commanded_N[i].dot(way_m);
    result.true_work_J += series.true_N[i].dot(way_m);
  }
}

void measure_what_is_left(const ForceSeries& series, const std::vector<bool>& used, const Mat3& rotation,
                          ForceComparison& result) {
  static const SlowPart slow;
  std::vector<Vec3> left_N(used.size());
  double angle_rad = 0.0, angles = 0.0, noise_N2 = 0.0;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const Vec3 true_N = force_at(series.true_N, static_cast<double>(i) - kRate_Hz * result.lag_s);
    left_N[i] = series.commanded_N[i] - result.gain * (rotation * true_N);
    if (!used[i] || true_N.norm() < 0.1 * result.true_peak_N) continue;
    angle_rad += std::atan2(true_N.cross(series.commanded_N[i]).norm(), true_N.dot(series.commanded_N[i]));
    angles += 1.0;
  }
  result.mean_angle_rad = angles > 0.0 ? angle_rad / angles : kNotKnown;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) noise_N2 += (left_N[i] - slow.at(left_N, used, i)).squaredNorm();
  result.noise_rms_N = std::sqrt(noise_N2 / static_cast<double>(result.ticks));
  result.noise_N2_Hz = spectrum_of(left_N, used);
}

}  // namespace

double swing_N(std::span<const Vec3> force_N) {
  constexpr std::size_t kWindow_ticks = 50;
  if (force_N.size() < kWindow_ticks) return 0.0;
  Vec3 sum_N = Vec3::Zero();  // of the window
  for (std::size_t i = 0; i < kWindow_ticks; ++i) sum_N += force_N[i];
  double sum_N2 = 0.0;
  const std::size_t count = force_N.size() - kWindow_ticks + 1;
  for (std::size_t first = 0; first < count; ++first) {
    if (first > 0) sum_N += force_N[first + kWindow_ticks - 1] - force_N[first - 1];
    sum_N2 += (force_N[first + kWindow_ticks / 2] - sum_N / static_cast<double>(kWindow_ticks)).squaredNorm();
  }
  return std::sqrt(sum_N2 / static_cast<double>(count));
}

Vec3 force_at(const std::vector<Vec3>& force, double tick) {
  const auto last = static_cast<long>(force.size()) - 1;
  const double before = std::floor(tick);
  const double s = tick - before;
  const auto at = [&](long offset) {
    return force[static_cast<std::size_t>(std::clamp(static_cast<long>(before) + offset, 0L, last))];
  };
  if (s == 0.0) return at(0);
  // Lagrange's cubic through the four neighbours.
  return -s * (s - 1.0) * (s - 2.0) / 6.0 * at(-1) + (s + 1.0) * (s - 1.0) * (s - 2.0) / 2.0 * at(0) -
         (s + 1.0) * s * (s - 2.0) / 2.0 * at(1) + (s + 1.0) * s * (s - 1.0) / 6.0 * at(2);
}

ForceComparison compare_forces(const ForceSeries& series) {
  ForceComparison result;
  const std::vector<bool> used = near_touch(series);
  measure_size_and_error(series, used, result);
  measure_work(series, result);
  if (result.ticks < kFewest_ticks) {
    result.gain = result.lag_s = result.mean_angle_rad = result.noise_rms_N = kNotKnown;
    result.rotation_rad.setConstant(kNotKnown);
    return result;
  }
  const double lag_ticks = best_lag_ticks(series, used);
  const Fit fit = fit_at(series, used, lag_ticks);
  result.gain = fit.gain;
  result.lag_s = lag_ticks / kRate_Hz;
  result.rotation_rad = rotation_vector(fit.rotation);
  measure_what_is_left(series, used, fit.rotation, result);
  return result;
}

}  // namespace myotact::measure
