#pragma once

namespace myotact::simulation {

/// Time constants of a muscle's first-order activation dynamics, when rising and when falling.
struct ActivationTimes {
  double activation_s = 0.015;
  double deactivation_s = 0.050;
};

/// Activation after dt_s under the constant excitation, both 0 .. 1:
///   da/dt = (u - a) / tau,  tau = activation (1/2 + 3/2 a) when u > a, deactivation / (1/2 + 3/2 a) when u < a
/// (Thelen, J Biomech Eng 125:70, 2003). The exact solution of the step, so any dt_s is stable. Arguments outside 0 ..
/// 1 are clamped; a time constant <= 0 follows the excitation at once. Real-time safe.
double step_activation(double activation, double excitation, const ActivationTimes& times, double dt_s) noexcept;

}  // namespace myotact::simulation
