#include "haptics/gate/motor_heat.h"

#include <algorithm>
#include <cmath>

namespace myotact::haptics {

namespace {

/// Windings of small motors warm up within 10 to 30 s (general knowledge; no maker of a haptic device says so).
constexpr double kWarmUp_s = 20.0;
constexpr double kWarm = 0.7;  // of the heat that may be: from here on the limit falls

}  // namespace

MotorHeat::MotorHeat(double continuous_N, double most_N)
    : continuous_N_(std::min(continuous_N, most_N)), most_N_(most_N) {}

void MotorHeat::book(double force_N, double elapsed_s) noexcept {
  if (!(continuous_N_ > 0.0)) return;
  const double wanted = (force_N / continuous_N_) * (force_N / continuous_N_);
  heat_ += (1.0 - std::exp(-elapsed_s / kWarmUp_s)) * (wanted - heat_);
}

double MotorHeat::limit_N() const noexcept {
  const double share = std::clamp((heat_ - kWarm) / (1.0 - kWarm), 0.0, 1.0);
  return most_N_ + share * (continuous_N_ - most_N_);
}

}  // namespace myotact::haptics
