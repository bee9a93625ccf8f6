#pragma once

#include "simulation/material/fibre_family.h"

namespace myotact::simulation {

namespace detail {

/// g(x) = arccosh(x)^2 and its slopes. Smooth through x = 1 (where it is a series), straight below x = 1/2, which no
/// deformation with J > 0 reaches.
struct SquaredArccosh {
  double value = 0.0, slope = 0.0, curvature = 0.0;
};

/// At any finite x.
inline SquaredArccosh squared_arccosh(double x) {
  constexpr double kSeries = 1e-2;  // below, the quotients would lose digits; the series' next term is 1e-17
  constexpr double kStraight = 0.5;
  if (x < kStraight) {
    const SquaredArccosh end = squared_arccosh(kStraight);
    return {end.value + end.slope * (x - kStraight), end.slope, 0.0};
  }
  const double t = x - 1.0;
  if (std::abs(t) < kSeries) {
    // arccosh^2 (1 + t) = sum_k (-1)^(k+1) 2^k (k!)^2 / (k^2 (2k)!) * 2 t^k
    SquaredArccosh sum;
    double factor = 2.0, power = 1.0;  // of t^k for k = 1, and t^(k-1)
    for (int k = 1; k <= 8; ++k) {
      sum.value += factor * power * t;
      sum.slope += factor * k * power;
      if (k > 1) sum.curvature += factor * k * (k - 1) * power / t;
      factor *= -static_cast<double>(k) * k / ((k + 1.0) * (2.0 * k + 1.0));
      power *= t;
    }
    if (t == 0.0) sum.curvature = -2.0 / 3.0;
    return sum;
  }
  const double root = std::sqrt(std::abs(x * x - 1.0));
  const double angle = x > 1.0 ? std::acosh(x) : std::acos(x);
  const double slope = 2.0 * angle / root;
  return {x > 1.0 ? angle * angle : -angle * angle, slope, (2.0 - x * slope) / (x * x - 1.0)};
}

}  // namespace detail

/// Muscle and tendon after Blemker, Pinsky and Delp (J Biomech 38:657, 2005): shear along and across the fibres, fibres
/// of the isochoric stretch, and K/2 (ln J)^2:
///   W = G1 B1^2 + G2 B2^2 + w(stretch),  B1^2 = I5 / I4^2 - 1,  cosh B2 = (I1 I4 - I5) / (2 sqrt I4).
template <FibreCurve Curve>
struct BlemkerMuscle {
  double along_Pa = 0.0;   // G1
  double across_Pa = 0.0;  // G2
  double bulk_Pa = 0.0;    // K
  Curve curve;             // slope of w against the isochoric stretch

  /// What shear and fibres take of the deformation.
  static constexpr Uses kUses{.I1 = true, .J = true, .I4 = true, .I5 = true};

  /// Adds the energy without that of volume(). `activation` 0 .. 1. Real is double here.
  template <class Real>
  MYOTACT_INLINE void add_energy(const Point<Real>& p, const Real& activation, Response<Real>& out) const {
    const IsochoricValues<Real> bar = isochoric_values(invariants_of<Real, kUses>(p));
    out.energy_Pa += shear_slopes(bar.values).energy_Pa;
    FibreFamily<Curve, FibreStretch::Isochoric>{curve}.add_energy(p, activation, out);
  }

  /// Adds stress and tangent without those of volume(), and no energy.
  template <class Real>
  MYOTACT_INLINE void add(const Point<Real>& p, const Real& activation, Response<Real>& out) const {
    const IsochoricValues<Real> bar = isochoric_values(invariants_of<Real, kUses>(p));
    Slopes<Real> slopes = shear_slopes(bar.values);
    const auto law = [&](double stretch, int lane) { return curve.at(stretch, lane_of(activation, lane)); };
    const detail::FibreSlopes<Real> fibre = detail::fibre_slopes(bar.values[kI4], law);
    slopes.first[kI4] += fibre.first;
    slopes.second[kI4][kI4] += fibre.second;
    add_slopes<Real, kUses>(p, from_isochoric(slopes, bar.values, bar.scale, bar.ratio), out);
  }

  /// The volume term U(J), U', U''.
  template <class Real>
  MYOTACT_INLINE VolumeTerm<Real> volume(const Real& J) const {
    return logarithmic_volume(bulk_Pa, J);
  }

 private:
  template <class Real>
  MYOTACT_INLINE Slopes<Real> shear_slopes(const Invariants<Real>& bar) const {
    Slopes<Real> out;
    const Real I4 = larger(bar[kI4], constant<Real>(kShortestStretch * kShortestStretch));
    const Real inverse = 1.0 / I4, root = square_root(I4);
    // G1 (I5 / I4^2 - 1)
    const Real first5 = along_Pa * inverse * inverse;
    out.energy_Pa = first5 * bar[kI5] - along_Pa;
    out.first[kI5] = first5;
    out.first[kI4] = -2.0 * first5 * inverse * bar[kI5];
    out.second[kI4][kI5] = -2.0 * first5 * inverse;
    out.second[kI4][kI4] = 6.0 * first5 * inverse * inverse * bar[kI5];
    // G2 g(x), x = (I1 I4 - I5) / (2 sqrt I4)
    const Real half = 0.5 / root;
    const Real x = (bar[kI1] * I4 - bar[kI5]) * half;
    const Real x1 = 0.5 * root, x5 = -half, x4 = bar[kI1] * half - 0.5 * x * inverse;
    const Real x14 = 0.5 * half, x45 = 0.5 * half * inverse;
    const Real x44 = -0.5 * bar[kI1] * half * inverse - 0.5 * inverse * x4 + 0.5 * x * inverse * inverse;
    const Real g1 = across_Pa * each(x, [](double v) { return detail::squared_arccosh(v).slope; });
    const Real g2 = across_Pa * each(x, [](double v) { return detail::squared_arccosh(v).curvature; });
    out.energy_Pa += across_Pa * each(x, [](double v) { return detail::squared_arccosh(v).value; });
    out.first[kI1] += g1 * x1;
    out.first[kI4] += g1 * x4;
    out.first[kI5] += g1 * x5;
    out.second[kI1][kI1] += g2 * x1 * x1;
    out.second[kI1][kI4] += g2 * x1 * x4 + g1 * x14;
    out.second[kI1][kI5] += g2 * x1 * x5;
    out.second[kI4][kI4] += g2 * x4 * x4 + g1 * x44;
    out.second[kI4][kI5] += g2 * x4 * x5 + g1 * x45;
    out.second[kI5][kI5] += g2 * x5 * x5;
    return out;
  }
};

}  // namespace myotact::simulation
