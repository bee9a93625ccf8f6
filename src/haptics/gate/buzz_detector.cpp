#include "haptics/gate/buzz_detector.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace myotact::haptics {

namespace {

constexpr double kReversalsPerSecond = 30.0;  // own choice: tremor reverses 16 to 24 times
/// The strongest texture (0.3 N, from 30 Hz) swings a hand and stylus of 0.17 kg by 0.1 mm from end to end.
constexpr double kSwing_m = 150e-6;
constexpr double kCounts = 4.0;  // as a calm wall is recognised (calm_stiffness.h of measure)
constexpr double kLasts = 0.7;   // of a swing eight reversals ago: 1.4 % of the critical damping lets it fall that far
constexpr double kSoftest = 0.125;
constexpr double kDoubling_s = 10.0;
constexpr double kFeltFor_s = 0.1;  // a tool that buzzes at a wall leaves it in every swing

}  // namespace

BuzzDetector::BuzzDetector(double resolution_m) : swing_m_(std::max(kSwing_m, kCounts * resolution_m)) {}

bool BuzzDetector::reverses_too_often(Axis& axis, double x_m) const noexcept {
  const double back_m = axis.direction * (axis.farthest_m - x_m);
  if (axis.direction == 0) {
    if (std::abs(x_m - axis.farthest_m) < swing_m_) return false;
    axis.direction = x_m > axis.farthest_m ? 1 : -1;
    axis.farthest_m = x_m;
    return false;
  }
  if (back_m <= 0.0) axis.farthest_m = x_m;
  if (back_m < swing_m_) return false;
  const std::size_t at = axis.reversals % kReversals;
  const double oldest_s = axis.reversed_s[at], oldest_m = axis.swung_m[at];
  const double swung_m = std::abs(axis.farthest_m - axis.reversed_at_m);
  axis.direction = -axis.direction;
  axis.reversed_at_m = axis.farthest_m;
  axis.farthest_m = x_m;
  axis.reversed_s[at] = now_s_;
  axis.swung_m[at] = swung_m;
  if (!std::exchange(axis.reversed, true)) return false;
  ++axis.reversals;
  const bool often = now_s_ - oldest_s < static_cast<double>(kReversals) / kReversalsPerSecond;
  return axis.reversals > kReversals && often && swung_m > kLasts * oldest_m;
}

bool BuzzDetector::tick(const Vec3& position_m, bool feels, double dt_s) noexcept {
  now_s_ += dt_s;
  share_ = std::min(1.0, share_ * std::exp2(dt_s / kDoubling_s));
  if (feels) felt_s_ = now_s_;
  if (now_s_ - felt_s_ > kFeltFor_s || !knows_place_) {
    knows_place_ = position_m.allFinite();
    axes_ = {};
    for (int k = 0; k < 3 && knows_place_; ++k) axes_[static_cast<std::size_t>(k)].farthest_m = position_m[k];
    return false;
  }
  bool buzzes = false;
  for (int k = 0; k < 3; ++k) buzzes = reverses_too_often(axes_[static_cast<std::size_t>(k)], position_m[k]) || buzzes;
  if (!buzzes) return false;
  for (Axis& axis : axes_) axis.reversals = 0;
  share_ = std::max(kSoftest, 0.5 * share_);
  return true;
}

}  // namespace myotact::haptics
