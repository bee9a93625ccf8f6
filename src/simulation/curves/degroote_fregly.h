#pragma once

namespace myotact::simulation::degroote_fregly {

// The passive fibre of De Groote, Kinney, Rao and Fregly, Ann Biomed Eng 44:2922 (2016), as published. The rest of the
// family is that of the muscles themselves (fibre_curves.h), which leave this curve along its tangent.

/// Strain 0.6 at peak force, shape 4, 0 at n = 0.2. Past n = 2 a straight line, so that nothing overflows.
/// Slightly negative below n = 0.2.
double passive_force_length(double n) noexcept;
double passive_force_length_slope(double n) noexcept;

}  // namespace myotact::simulation::degroote_fregly
