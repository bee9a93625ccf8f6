#pragma once

namespace myotact::simulation::blemker {

// The along-fibre curves of Blemker, Pinsky and Delp, J Biomech 38:657 (2005). Arguments as in curve_set.h.

/// Three parabolas, whose slopes differ where they meet at 0.6 and 1.4 (3.6 and 3.2); 0 outside 0.4 .. 1.6.
/// At a kink the slope is that of the left side.
double active_force_length(double n) noexcept;
double active_force_length_slope(double n) noexcept;

/// Exponential from n = 1 on, straight beyond 1.4.
double passive_force_length(double n) noexcept;
double passive_force_length_slope(double n) noexcept;

}  // namespace myotact::simulation::blemker
