#include "simulation/muscle/activation.h"

#include <algorithm>
#include <cmath>

namespace myotact::simulation {
namespace {

/// Rising: with w = ln((u - a0) / (u - a)) the solution is (1/2 + 3/2 u) w - 3/2 (u - a0) (1 - e^-w) = dt / tau.
/// The left side is convex and rising, so Newton's method from an upper bound goes down to the root without overshoot.
double rise(double a0, double u, double steps) noexcept {
  const double limit_slope = 0.5 + 1.5 * u;
  const double gap = u - a0;
  double w = (steps + 1.5 * gap) / limit_slope;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const double decay = std::exp(-w);
    const double residual = limit_slope * w - 1.5 * gap * (1.0 - decay) - steps;
    const double change = residual / (limit_slope - 1.5 * gap * decay);
    w -= change;
    if (std::abs(change) <= 1e-14 * (1.0 + w)) break;
  }
  return u - gap * std::exp(-w);
}

/// Falling: (1/2 + 3/2 a) / (a - u) grows by exp((1/2 + 3/2 u) dt / tau).
double fall(double a0, double u, double steps) noexcept {
  const double inverse_ratio = (a0 - u) / (0.5 + 1.5 * a0) * std::exp(-(0.5 + 1.5 * u) * steps);
  return (u + 0.5 * inverse_ratio) / (1.0 - 1.5 * inverse_ratio);
}

}  // namespace

double step_activation(double activation, double excitation, const ActivationTimes& times, double dt_s) noexcept {
  const double a0 = std::clamp(activation, 0.0, 1.0);
  const double u = std::clamp(excitation, 0.0, 1.0);
  // Clamped again, because rounding may step over either end by a last digit.
  if (u > a0) return times.activation_s > 0.0 ? std::clamp(rise(a0, u, dt_s / times.activation_s), a0, u) : u;
  if (u < a0) return times.deactivation_s > 0.0 ? std::clamp(fall(a0, u, dt_s / times.deactivation_s), u, a0) : u;
  return a0;
}

}  // namespace myotact::simulation
