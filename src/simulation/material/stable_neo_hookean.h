#pragma once

#include "simulation/material/invariants.h"

namespace myotact::simulation {

/// Stable neo-Hookean law, log form (Smith, de Goes, Kim, ACM TOG 37:12, 2018, eq. 14 with their Lame mapping):
///   W = m/2 (I1 - 3) - m/2 ln(I1 + 1) + L/2 (J - alpha)^2,  m = 4/3 mu, L = lambda + 5/6 mu, alpha = 1 + 3/4 m / L.
/// Smooth and finite for every F, inverted or collapsed.
struct StableNeoHookean {
  double shear_Pa = 0.0;   // mu, Lame
  double lambda_Pa = 0.0;  // first Lame parameter

  /// m and L.
  double shear_term_Pa() const { return 4.0 / 3.0 * shear_Pa; }
  double volume_term_Pa() const { return lambda_Pa + 5.0 / 6.0 * shear_Pa; }
  /// Volume ratio at which the volume term alone would rest, so that the whole law rests at J = 1.
  double rest_ratio() const { return 1.0 + 0.75 * shear_term_Pa() / volume_term_Pa(); }

  /// Adds the energy without that of volume(). `activation` 0 .. 1.
  template <class Real>
  MYOTACT_INLINE void add_energy(const Point<Real>& p, const Real& /*activation*/, Response<Real>& out) const {
    const double m = shear_term_Pa();
    // Zero at rest together with the volume term, which is not zero there on its own.
    const double rest = 0.5 * volume_term_Pa() * (1.0 - rest_ratio()) * (1.0 - rest_ratio()) - 0.5 * m * std::log(4.0);
    out.energy_Pa += 0.5 * m * (p.I1 - 3.0 - logarithm(p.I1 + 1.0)) - rest;
  }

  /// Adds stress and tangent without those of volume(), and no energy.
  template <class Real>
  MYOTACT_INLINE void add(const Point<Real>& p, const Real& /*activation*/, Response<Real>& out) const {
    const double m = shear_term_Pa();
    const Real inverse = 1.0 / (p.I1 + 1.0);
    const Real scale = m - m * inverse;
    for (std::size_t k = 0; k < 9; ++k) out.P[k] += scale * p.F[k];
    add_unit(scale, out.C);
    add_outer<Real>(p.F, 2.0 * m * inverse * inverse, out.C);
  }

  /// The volume term U(J), U', U''.
  template <class Real>
  MYOTACT_INLINE VolumeTerm<Real> volume(const Real& J) const {
    const double L = volume_term_Pa();
    const Real gap = J - rest_ratio();
    return {0.5 * L * gap * gap, L * gap, constant<Real>(L)};
  }
};

}  // namespace myotact::simulation
