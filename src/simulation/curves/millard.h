#pragma once

namespace myotact::simulation::millard {

// The curves of Millard, Uchida, Seth and Delp, J Biomech Eng 135:021005 (2013; "Millard 2012" after OpenSim's class),
// as cubics through the points and slopes that the paper's parameters set. OpenSim draws quintic Bezier curves through
// the same points, whose elbows round the corners between them differently, by up to 0.08 of the peak force; the
// published samples that we compare with (ArtiSynth's) are the cubics'. Arguments as in curve_set.h.

/// Least value 0, as in the paper's damped model.
double active_force_length(double n) noexcept;
double active_force_length_slope(double n) noexcept;

/// 0 up to n = 1, strain 0.7 at peak force; straight beyond.
double passive_force_length(double n) noexcept;
double passive_force_length_slope(double n) noexcept;

/// 0 for v <= -1, 1.4 for v >= 1.
double force_velocity(double v) noexcept;
double force_velocity_slope(double v) noexcept;
/// The v at which the force is `force`, within -1 .. 1. By bisection.
double velocity_at_force(double force) noexcept;

/// 0 for a slack tendon, 1 at 4.9 % strain, straight from 2/3 of peak force on.
double tendon_force(double stretch) noexcept;
double tendon_force_slope(double stretch) noexcept;

}  // namespace myotact::simulation::millard
