#pragma once

namespace myotact::simulation::thelen {

// The curves of Thelen, J Biomech Eng 125:70 (2003), with a young adult's constants. Arguments as in curve_set.h.

/// A Gaussian about n = 1 and its derivative.
double active_force_length(double n) noexcept;
double active_force_length_slope(double n) noexcept;

/// 0 up to n = 1. Past n = 2 a straight line, so that nothing overflows.
double passive_force_length(double n) noexcept;
double passive_force_length_slope(double n) noexcept;

/// Hill's hyperbola when shortening, and one that meets it without a kink when lengthening. Equation 7 of the paper
/// lengthens twice as stiffly, which makes the slope jump at v = 0 and Newton's method cycle there; the published
/// samples that we compare with leave the factor out as well. The activation scales the largest shortening speed.
double force_velocity(double v, double activation) noexcept;
double force_velocity_slope(double v, double activation) noexcept;
/// The v at which the force is `force`: the paper's own, explicit direction.
double velocity_at_force(double force, double activation) noexcept;

/// Exponential toe, then straight: 1 at 3.3 % strain. 0 for a slack tendon.
double tendon_force(double stretch) noexcept;
double tendon_force_slope(double stretch) noexcept;

}  // namespace myotact::simulation::thelen
