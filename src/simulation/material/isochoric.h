#pragma once

#include "simulation/material/invariants.h"

// Laws that part a deformation into a change of volume and the rest are functions of the rest's invariants, J^-p I.

namespace myotact::simulation {

/// J^(-2/3) I1, J^(-4/3) I2 ..., and what they were made with.
template <class Real>
struct IsochoricValues {
  PositiveRatio<Real> ratio;  // of J
  Real scale{};               // j^(-2/3)
  Invariants<Real> values{};  // that of J is 0
};

/// From the invariants; J must be among them.
template <class Real>
MYOTACT_INLINE IsochoricValues<Real> isochoric_values(const Invariants<Real>& inv) {
  IsochoricValues<Real> out;
  out.ratio = positive_ratio(inv[kJ]);
  const Real root = each(out.ratio.j, [](double j) { return std::cbrt(j); });
  out.scale = 1.0 / (root * root);
  const Real squared = out.scale * out.scale;
  out.values = {out.scale * inv[kI1], squared * inv[kI2], Real{}, out.scale * inv[kI4], squared * inv[kI5]};
  return out;
}

/// From slopes against the isochoric invariants J^-p I to those against the invariants and J themselves.
/// `bar_values`, `scale_third` and `ratio` are the members of IsochoricValues. The energy is not carried over.
template <class Real>
MYOTACT_INLINE Slopes<Real> from_isochoric(const Slopes<Real>& bar, const Invariants<Real>& bar_values,
                                           const Real& scale_third, const PositiveRatio<Real>& ratio) {
  // J^-p with p = 2/3 for I1 and I4, 4/3 for I2 and I5; scale_third = j^(-2/3).
  constexpr std::array<double, kInvariants> power{2.0 / 3.0, 4.0 / 3.0, 0.0, 2.0 / 3.0, 4.0 / 3.0};
  const std::array<Real, kInvariants> scale{scale_third, scale_third * scale_third, constant<Real>(1.0), scale_third,
                                            scale_third * scale_third};
  Slopes<Real> out;
  Real slope{}, curvature{};  // against j
  for (std::size_t a = 0; a < kInvariants; ++a) {
    if (a == kJ) continue;
    const Real rate = -power[a] * bar_values[a] / ratio.j;  // of the isochoric invariant against j
    out.first[a] = bar.first[a] * scale[a];
    slope += bar.first[a] * rate;
    curvature += bar.first[a] * (power[a] * (power[a] + 1.0)) * bar_values[a] / (ratio.j * ratio.j);
    Real with_j = bar.first[a] * (-power[a]) * scale[a] / ratio.j;
    for (std::size_t b = 0; b < kInvariants; ++b) {
      if (b == kJ) continue;
      const Real second = a <= b ? bar.second[a][b] : bar.second[b][a];
      const Real rate_b = -power[b] * bar_values[b] / ratio.j;
      if (a <= b) out.second[a][b] = second * scale[a] * scale[b];
      with_j += second * scale[a] * rate_b;
      curvature += second * rate * rate_b;
    }
    (a < kJ ? out.second[a][kJ] : out.second[kJ][a]) = with_j * ratio.slope;
  }
  out.first[kJ] = slope * ratio.slope;
  out.second[kJ][kJ] = curvature * ratio.slope * ratio.slope + slope * ratio.curvature;
  return out;
}

}  // namespace myotact::simulation
