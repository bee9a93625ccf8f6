#include "simulation/line/hill_muscle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulation/curves/fibre_curves.h"

namespace myotact::simulation {
namespace {

constexpr double kRigid = std::numeric_limits<double>::infinity();

/// The fibres at one reach along the tendon.
struct Fibres {
  double fibre_m, force_N, stiffness_N_m, damping_Ns_m;
};

Fibres fibres_at(const HillMuscle& muscle, const HillStep& step, double reach_m) {
  const double lo = muscle.optimal_fibre_m;
  const double w = fibre_width_m(muscle);
  const double l = std::hypot(reach_m, w);
  const double cosine = w > 0.0 ? reach_m / l : 1.0;
  const double sine_squared_over_l = w > 0.0 ? (w / l) * (w / l) / l : 0.0;
  const double n = l / lo;
  const double largest_m_s = kLargestShortening_lo_s * lo;
  const double v = (step.rule.rate_1_s * l - step.rule.history(step.fibre_m, step.fibre_before_m)) / largest_m_s;
  const double passive = passive_force_length(n);
  const double passive_slope = passive > 0.0 ? passive_force_length_slope(n) : 0.0;
  const double active = step.activation * active_force_length(n);
  const double active_slope = step.activation * active_force_length_slope(n);
  const double damping = muscle.peak_force_N * active * force_velocity_slope(v) / largest_m_s;  // dF/d(dl/dt)
  const double force_N = muscle.peak_force_N * (active * force_velocity(v) + std::max(passive, 0.0));
  const double slope =
      muscle.peak_force_N / lo * (active_slope * force_velocity(v) + passive_slope) + damping * step.rule.rate_1_s;
  return {l, force_N * cosine, slope * cosine * cosine + force_N * sine_squared_over_l, damping * cosine * cosine};
}

/// The tendon when the fibres take `reach_m` of the unit.
struct Pull {
  double force_N, stiffness_N_m;
};

Pull tendon_at(const HillMuscle& muscle, double length_m, double reach_m) {
  const double stretch = (length_m - reach_m) / muscle.tendon_slack_m;
  return {muscle.peak_force_N * std::max(tendon_force(stretch), 0.0),
          muscle.peak_force_N * tendon_force_slope(stretch) / muscle.tendon_slack_m};
}

/// Between reaches where the tendon pulls more than the fibres (`low`) and less (`high`).
struct Bracket {
  double low_m, high_m;
};

/// At rest the curve of the fibres falls beyond the optimum and may meet the tendon's several times: comes down from
/// the straight tendon to the first place where the tendon pulls more.
Bracket longest_balance(const HillMuscle& muscle, const HillStep& step, const Bracket& whole) {
  constexpr int kParts = 32;
  Bracket part = whole;
  for (int i = kParts - 1; i > 0; --i) {
    const double reach_m = whole.low_m + (whole.high_m - whole.low_m) * i / kParts;
    if (fibres_at(muscle, step, reach_m).force_N < tendon_at(muscle, step.length_m, reach_m).force_N) {
      part.low_m = reach_m;
      return part;
    }
    part.high_m = reach_m;
  }
  return part;
}

/// Newton's method from the last fibre length, that halves the bracket wherever it would leave it or converge more
/// slowly than halving.
double balanced_reach_m(const HillMuscle& muscle, const HillStep& step, Bracket bracket) {
  constexpr int kMost = 200;  // halving alone ends after some 60
  const double w = fibre_width_m(muscle);
  double reach_m = std::sqrt(std::max((step.fibre_m - w) * (step.fibre_m + w), 0.0));
  if (!(reach_m > bracket.low_m && reach_m < bracket.high_m)) reach_m = 0.5 * (bracket.low_m + bracket.high_m);
  double last_move_m = bracket.high_m - bracket.low_m;
  for (int i = 0; i < kMost; ++i) {
    const Fibres fibres = fibres_at(muscle, step, reach_m);
    const Pull tendon = tendon_at(muscle, step.length_m, reach_m);
    const double excess_N = fibres.force_N - tendon.force_N;
    if (excess_N == 0.0) return reach_m;
    (excess_N > 0.0 ? bracket.high_m : bracket.low_m) = reach_m;
    const double slope_N_m = fibres.stiffness_N_m + tendon.stiffness_N_m;
    double next_m = reach_m - excess_N / slope_N_m;
    const bool inside = next_m > bracket.low_m && next_m < bracket.high_m;
    const bool fast = std::abs(next_m - reach_m) < 0.5 * last_move_m;
    if (!(slope_N_m > 0.0 && inside && fast)) next_m = 0.5 * (bracket.low_m + bracket.high_m);
    last_move_m = std::abs(next_m - reach_m);
    if (next_m == reach_m || last_move_m <= std::numeric_limits<double>::epsilon() * step.length_m * 0.25)
      return next_m;
    reach_m = next_m;
  }
  return reach_m;
}

HillForce slack_unit(const HillMuscle& muscle) {
  HillForce force;
  force.fibre_m = fibre_width_m(muscle);
  return force;
}

/// Of two springs in a row, either of which may be rigid (infinity).
double in_series(double a_N_m, double b_N_m) {
  if (std::isinf(a_N_m)) return b_N_m;
  if (std::isinf(b_N_m)) return a_N_m;
  const double both_N_m = a_N_m + b_N_m;
  return both_N_m == 0.0 ? 0.0 : a_N_m / both_N_m * b_N_m;
}

/// The fibres' side gives the force: mostly the less steep of the two curves, which loses fewer digits.
HillForce unit_of(const Fibres& fibres, double tendon_stiffness_N_m) {
  return {fibres.fibre_m,
          fibres.force_N,
          fibres.stiffness_N_m,
          tendon_stiffness_N_m,
          in_series(fibres.stiffness_N_m, tendon_stiffness_N_m),
          fibres.damping_Ns_m};
}

}  // namespace

double fibre_width_m(const HillMuscle& muscle) noexcept {
  return muscle.optimal_fibre_m * std::sin(muscle.pennation_rad);
}

double tendon_slack_for_m(const HillMuscle& muscle, double length_m, double rest_stretch) noexcept {
  const double l = rest_stretch * muscle.optimal_fibre_m;
  const double w = fibre_width_m(muscle);
  return length_m - std::sqrt((l - w) * (l + w));
}

HillForce hill_step(const HillMuscle& muscle, const HillStep& step) noexcept {
  const double straight_m = step.length_m - muscle.tendon_slack_m;  // reach at which the tendon goes slack
  if (!(straight_m > 0.0)) return slack_unit(muscle);
  if (muscle.tendon == Tendon::Rigid) return unit_of(fibres_at(muscle, step, straight_m), kRigid);
  const Pull longest = tendon_at(muscle, step.length_m, 0.0);
  if (fibres_at(muscle, step, 0.0).force_N >= longest.force_N) {  // fibres that cannot get any shorter
    return unit_of({fibre_width_m(muscle), longest.force_N, kRigid, 0.0}, longest.stiffness_N_m);
  }
  Bracket bracket{0.0, straight_m};
  if (step.rule.rate_1_s == 0.0) bracket = longest_balance(muscle, step, bracket);
  const double reach_m = balanced_reach_m(muscle, step, bracket);
  return unit_of(fibres_at(muscle, step, reach_m), tendon_at(muscle, step.length_m, reach_m).stiffness_N_m);
}

HillForce hill_equilibrium(const HillMuscle& muscle, double length_m, double activation, FibreStiffness kind) noexcept {
  HillStep still;
  still.length_m = length_m;
  still.activation = activation;
  HillForce force = hill_step(muscle, still);
  if (kind == FibreStiffness::ForceLength || force.force_N == 0.0) return force;
  const double sine = fibre_width_m(muscle) / force.fibre_m;
  const double cosine_squared = (1.0 - sine) * (1.0 + sine);
  const double fibre_N = force.force_N / std::sqrt(cosine_squared);
  force.fibre_stiffness_N_m =
      fibre_N * (kShortRangeStiffness / muscle.optimal_fibre_m * cosine_squared + sine * sine / force.fibre_m);
  force.stiffness_N_m = in_series(force.fibre_stiffness_N_m, force.tendon_stiffness_N_m);
  return force;
}

}  // namespace myotact::simulation
