#include "scene/rate_meter.h"

namespace myotact::scene {

const messages::RateFrame& RateMeter::add(const Count& count) {
  constexpr double kWindow_s = 1.0;
  if (!begun_) {
    begun_ = true;
    since_ = count;
  }
  rates_.missed_ticks = count.missed_ticks;
  const double passed_s = static_cast<double>(count.now_ns - since_.now_ns) * 1e-9;
  const bool whole = passed_s >= kWindow_s;
  if (passed_s <= 0.0 || !(whole || first_second_)) return rates_;
  const auto steps = static_cast<double>(count.steps - since_.steps);
  rates_.simulation_hz = steps / passed_s;
  rates_.haptic_hz = static_cast<double>(count.ticks - since_.ticks) / passed_s;
  rates_.time_factor = steps * dt_s_ / passed_s;
  if (!whole) return rates_;
  first_second_ = false;
  since_ = count;
  return rates_;
}

}  // namespace myotact::scene
