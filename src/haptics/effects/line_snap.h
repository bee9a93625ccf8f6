#pragma once

#include <cstdint>

#include "core/vector.h"
#include "messages/local_model.h"

namespace myotact::haptics {

struct LineSnapSettings {
  double force_N = 0.0;   // the most that a line pulls with as the tool passes over it; 0: lines are not felt
  double reach_m = 8e-3;  // lines deeper under the tool are not felt, > 0
};

/// What a muscle line near the surface does to a tool that passes over it with an open hand: it draws the tool in and
/// lets it snap off on the other side. A potential of the distance r from the line,
///
///   U = -D (1 - (r/R)^2)^2 for r < R, else 0       |dU/dr| <= 1.54 D/R = force_N
///
/// so that what a line gives as the tool approaches it takes as the tool leaves. Another line is taken up only after
/// the last one has faded out (30 ms each). Real-time safe; one thread.
class LineSnap {
 public:
  explicit LineSnap(const LineSnapSettings& settings) : settings_(settings) {}

  /// Force on the hand [N]. `line` is the nearest known, `open`: the hand holds nothing. `dt_s` > 0.
  Vec3 tick(const messages::LocalLine& line, const Vec3& tool_m, bool open, double dt_s) noexcept;
  /// The most that the line may give back at any time [J].
  double held_J() const noexcept;

 private:
  double depth_J() const noexcept;

  LineSnapSettings settings_;
  messages::LocalLine line_;  // felt now; muscle -1: none
  double gain_ = 0.0;
};

}  // namespace myotact::haptics
