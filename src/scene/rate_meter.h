#pragma once

#include <cstdint>

#include "messages/scene_frame.h"

namespace myotact::scene {

/// How fast a running session is now: of about the last second, so that a pause or a slow start is soon forgotten.
class RateMeter {
 public:
  /// What has been counted since the session's start, at a moment of the steady clock.
  struct Count {
    std::uint64_t now_ns = 0;
    std::uint64_t steps = 0, ticks = 0, missed_ticks = 0;
  };

  /// `dt_s`: of a step.
  explicit RateMeter(double dt_s) : dt_s_(dt_s) {}

  /// The first count is where it begins. Within the first second the rates are those since the beginning.
  const messages::RateFrame& add(const Count& count);

 private:
  double dt_s_;
  bool begun_ = false, first_second_ = true;
  Count since_;
  messages::RateFrame rates_;
};

}  // namespace myotact::scene
