#pragma once

namespace myotact::simulation {

// The force curves of a muscle fibre after De Groote, Kinney, Rao and Fregly, Ann Biomed Eng 44:2922 (2016), with the
// constants of OpenSim's DeGrooteFregly2016Muscle (the first force-length bell rescaled so that its peak is 1).
// `n` is the fibre length over the optimal fibre length; `v` the lengthening speed over the largest shortening speed
// (v < 0 shortens). Forces are over the peak isometric force. All are finite for every finite argument; real-time safe.

/// Largest shortening speed in optimal fibre lengths a second (De Groote et al. 2016, table 1).
inline constexpr double kLargestShortening_lo_s = 10.0;

/// fL and its derivative: three bells about n = 1, never negative.
double active_force_length(double n) noexcept;
double active_force_length_slope(double n) noexcept;

/// Strain 0.6 at peak force, shape 4. Unlike the published curve (curves/degroote_fregly.h) it goes on as its tangent
/// past n = 1.4: the exponential would lift a muscle with short fibres to many times its peak force in poses that a
/// limb takes easily, and would overflow under a wild iterate of the solver.
double passive_force_length(double n) noexcept;
double passive_force_length_slope(double n) noexcept;

/// 0 for v <= -1: a fibre that shortens faster than it can does not push.
double force_velocity(double v) noexcept;
double force_velocity_slope(double v) noexcept;
/// The v at which the force is `force`, within -1 .. 1.
double velocity_at_force(double force) noexcept;

/// Of a tendon whose length is `stretch` times its slack length: 1 at 4.9 % strain, through 0 when slack, as low as
/// -0.2 below. Goes on as a straight line past 9.8 % strain, where no tendon is whole.
double tendon_force(double stretch) noexcept;
double tendon_force_slope(double stretch) noexcept;
/// The strain (stretch - 1) under a force of 0 to 1.
double tendon_strain_at(double force) noexcept;

}  // namespace myotact::simulation
