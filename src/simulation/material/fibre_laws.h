#pragma once

#include "simulation/curves/blemker.h"
#include "simulation/curves/curve_set.h"
#include "simulation/curves/fibre_curves.h"
#include "simulation/material/fibre_family.h"

namespace myotact::simulation {

/// Active and passive fibre of skeletal muscle by a published set of curves: nominal stress = peak (a fL(n) + fP(n)),
/// with the normalised length n = rest_length + gain (stretch - 1).
struct MuscleFibre {
  double peak_Pa = 0.0;                            // nominal stress at full activation and optimal length
  double rest_length = 1.0;                        // over the optimal length, at stretch 1
  double gain = 1.0;                               // dn / d(stretch)
  CurveSet curves = CurveSet::DeGrooteFregly2016;  // fL and fP

  /// Nominal stress and its slope; its integral from stretch 1. `activation` 0 .. 1, stretch > 0.
  FibreLaw at(double stretch, double activation) const {
    const double n = rest_length + gain * (stretch - 1.0);
    const ForceCurves& set = force_curves(curves);
    return {peak_Pa * (activation * set.active.value(n) + set.passive.value(n)),
            peak_Pa * gain * (activation * set.active.slope(n) + set.passive.slope(n))};
  }
  double energy_Pa(double stretch, double activation) const { return integrate_stress(*this, stretch, activation); }
};

/// Fibres of one of the program's own muscles as they are at a pose (muscle/fibre_field.h): active force goes by the
/// mean length of all fibres, which is held here, and so is a straight line; passive force by each one's own. Nominal
/// stress = peak (a (active + active_slope (stretch - 1)) + fP(passive_length + gain (stretch - 1))).
struct PosedFibre {
  double peak_Pa = 0.0;
  double active = 1.0;          // over the peak, at full activation and stretch 1
  double active_slope = 0.0;    // against the stretch
  double passive_length = 0.8;  // over the optimal length, at stretch 1
  double gain = 1.0;            // dn / d(stretch)

  /// Nominal stress and its slope; its integral from stretch 1. `activation` 0 .. 1, stretch > 0.
  FibreLaw at(double stretch, double activation) const {
    const double n = passive_length + gain * (stretch - 1.0);
    return {peak_Pa * (activation * (active + active_slope * (stretch - 1.0)) + passive_force_length(n)),
            peak_Pa * (activation * active_slope + gain * passive_force_length_slope(n))};
  }
  double energy_Pa(double stretch, double activation) const { return integrate_stress(*this, stretch, activation); }
};

/// Exponential toe and straight line: c3 (exp(c4 (stretch - 1)) - 1) / stretch up to the stretch `straight`, beyond it
/// (c5 stretch + c6) / stretch with the same value; nothing below 1. c5 <= 0: with the same slope. Tendon and passive
/// fibres of the uncoupled laws (Weiss, Maker and Govindjee 1996; Blemker et al. 2005).
struct ExponentialFibre {
  double toe_Pa = 0.0;       // c3
  double exponent = 0.0;     // c4
  double straight_Pa = 0.0;  // c5
  double straight = 1.0;     // stretch where the toe ends

  /// Nominal stress and its slope; its integral from stretch 1. `activation` 0 .. 1, stretch > 0.
  FibreLaw at(double stretch, double /*activation*/) const {
    if (stretch <= 1.0) return {};
    const double end = std::min(stretch, straight);
    const double growth = toe_Pa * std::exp(exponent * (end - 1.0));
    const double modulus = straight_Pa > 0.0 ? straight_Pa : exponent * growth;
    const double tension = growth - toe_Pa + modulus * (stretch - end);
    const double slope = stretch <= straight ? exponent * growth : modulus;
    return {tension / stretch, slope / stretch - tension / (stretch * stretch)};
  }
  double energy_Pa(double stretch, double activation) const { return integrate_stress(*this, stretch, activation); }
};

/// Fibres of Blemker's muscle: nominal stress = peak / optimal stretch (a fL(r) + fP(r)), r = stretch over the
/// optimal stretch.
/// fL as in curves/blemker.h, fP = P1 (exp(P2 (r - 1)) - 1) from r = 1, straight from `straight` on.
struct BlemkerFibre {
  double peak_Pa = 0.0;          // sigma max: nominal stress times the optimal stretch
  double optimal_stretch = 1.0;  // > 0
  double toe = 0.05;             // P1
  double exponent = 6.6;         // P2
  double straight = 1.4;         // r where the exponential ends

  /// Nominal stress and its slope; its integral from stretch 1. `activation` 0 .. 1, stretch > 0.
  FibreLaw at(double stretch, double activation) const {
    const double r = stretch / optimal_stretch;
    double passive = 0.0, passive_slope = 0.0;
    if (r > 1.0) {
      const double end = std::min(r, straight), growth = toe * std::exp(exponent * (end - 1.0));
      passive_slope = exponent * growth;
      passive = growth - toe + passive_slope * (r - end);
    }
    const double scale = peak_Pa / optimal_stretch;
    return {scale * (activation * blemker::active_force_length(r) + passive),
            scale / optimal_stretch * (activation * blemker::active_force_length_slope(r) + passive_slope)};
  }
  double energy_Pa(double stretch, double activation) const { return integrate_stress(*this, stretch, activation); }
};

}  // namespace myotact::simulation
