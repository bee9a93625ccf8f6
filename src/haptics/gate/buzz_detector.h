#pragma once

#include <array>
#include <cstdint>

#include "core/vector.h"

namespace myotact::haptics {

/// Detects a tool that buzzes against what it touches and returns by how much to soften the contact.
///
/// The motion along an axis has reversed when it has come back by `swing_m` from where it was farthest: smaller swings
/// are texture and encoder. More than 30 reversals a second for eight reversals running are no hand: tremor makes 16 to
/// 24 (8-12 Hz). Nor may the swings decay, as they do after a knock. Then the stiffness is halved, down to an eighth;
/// it grows back by 7 % a second, doubling in 10 s. Real-time safe; one thread.
class BuzzDetector {
 public:
  /// `resolution_m` of the encoder: swings of a few counts are ignored.
  explicit BuzzDetector(double resolution_m);

  /// One tick of `dt_s` > 0 with the device at `position_m`; `feels`: a force acts, else nothing can buzz.
  /// True: the stiffness was halved in this tick.
  bool tick(const Vec3& position_m, bool feels, double dt_s) noexcept;
  double stiffness_share() const noexcept { return share_; }  // 1/8 .. 1

 private:
  static constexpr std::size_t kReversals = 8;

  struct Axis {
    double farthest_m = 0.0;
    int direction = 0;           // +1, -1; 0: none yet
    bool reversed = false;       // before the first reversal the start of the motion is unknown: no swing
    double reversed_at_m = 0.0;  // where it last reversed
    std::array<double, kReversals> reversed_s{};
    std::array<double, kReversals> swung_m{};
    std::size_t reversals = 0;  // since the last halving
  };
  bool reverses_too_often(Axis& axis, double x_m) const noexcept;

  double swing_m_;
  double share_ = 1.0;
  double now_s_ = 0.0;
  double felt_s_ = -1.0;  // when a force last acted
  bool knows_place_ = false;
  std::array<Axis, 3> axes_{};
};

}  // namespace myotact::haptics
