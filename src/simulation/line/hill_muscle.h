#pragma once

#include "simulation/time_rule.h"

namespace myotact::simulation {

// One muscle and its tendon in series, one-dimensional: fibres of `fibre_curves.h` that keep their width
// w = lo sin(pennation) while their pennation changes, so that with x the fibres' reach along the tendon
//   l = sqrt(x^2 + w^2),  F = F0 (a fL(l/lo) fV(v) + fP(l/lo)) x/l,  unit length L = x + tendon.
// Neither fibres nor tendon push; a unit shorter than its slack tendon is slack. Forces are finite for finite
// arguments, found in bounded time; all functions are pure and real-time safe. Source: De Groote et al., Ann Biomed Eng
// 44:2922 (2016); constant width after Zajac 1989.

/// Whether the tendon stretches.
enum class Tendon { Rigid, Elastic };

/// What a unit is made of. Ranges are not checked.
struct HillMuscle {
  double peak_force_N = 0.0;      // F0 > 0
  double optimal_fibre_m = 0.0;   // lo > 0
  double pennation_rad = 0.0;     // at the optimal length; 0 .. < pi/2
  double tendon_slack_m = 0.0;    // >= 0; > 0 when elastic
  Tendon tendon = Tendon::Rigid;  // the tendon_slack_m of a rigid one is its length
};

/// w = lo sin(pennation): also the fibres' shortest length.
double fibre_width_m(const HillMuscle& muscle) noexcept;

/// The slack length of a tendon that is just straight when the whole unit has `length_m` and its fibres have
/// `rest_stretch` times their optimal length; negative when the unit is too short for that. NaN when the fibres would
/// be shorter than their width.
double tendon_slack_for_m(const HillMuscle& muscle, double length_m, double rest_stretch) noexcept;

/// Which stiffness the fibres have.
enum class FibreStiffness {
  ForceLength,  // slope of the force-length curves: of slow, large moves
  ShortRange    // gamma F/lo: of the first 1 % of lo, before cross-bridges let go
};

/// gamma of short-range stiffness, fibre force over stiffness in units of lo. Cui, Perreault, Maas and Sandercock,
/// J Biomech 41:1945 (2008), from memory.
inline constexpr double kShortRangeStiffness = 23.4;

/// State and linear response of a unit. Stiffnesses and damping act along the tendon, at held activation.
struct HillForce {
  double fibre_m = 0.0;               // l; w when the unit is slack
  double force_N = 0.0;               // F >= 0; 0 when the unit is slack
  double fibre_stiffness_N_m = 0.0;   // km = dF/dx, in a step with what its velocity adds; infinity at x = 0
  double tendon_stiffness_N_m = 0.0;  // kt; infinity when rigid; 0 when the unit is slack
  double stiffness_N_m = 0.0;         // k = dF/dL = km kt/(km + kt)
  double fibre_damping_Ns_m = 0.0;    // bm = dF/d(dx/dt) of the fibres; the tendon in series has none
};

/// State at rest under a unit length and an activation 0 .. 1. An elastic tendon some 20 times as long as the fibres
/// can have several lengths in balance with them; the longest fibres are chosen, those that a muscle reaches when its
/// activation grows from zero.
HillForce hill_equilibrium(const HillMuscle& muscle, double length_m, double activation,
                           FibreStiffness kind = FibreStiffness::ForceLength) noexcept;

/// One implicit step of the fibres.
struct HillStep {
  double length_m = 0.0;                       // L at the end of the step
  double activation = 0.0;                     // at the end of the step, 0 .. 1
  TimeRule rule;                               // all zero: no velocity, which is hill_equilibrium
  double fibre_m = 0.0, fibre_before_m = 0.0;  // l at the last instant and, for a second-order rule, the one before
};

/// The fibre length at the end of the step, with force-velocity implicit: F and k = dF/dL there are those of the step
/// itself (its algorithmic tangent), ready for Newton's method on the joint. The caller keeps `fibre_m` for the next
/// step. Start from hill_equilibrium.
HillForce hill_step(const HillMuscle& muscle, const HillStep& step) noexcept;

}  // namespace myotact::simulation
