#pragma once

#include "simulation/material/invariants.h"

namespace myotact::simulation {

/// Compressible neo-Hookean law in FEBio's form: W = mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2.
struct NeoHookean {
  double shear_Pa = 0.0;   // mu
  double lambda_Pa = 0.0;  // first Lame parameter

  /// Adds the energy without that of volume(). `activation` 0 .. 1.
  template <class Real>
  MYOTACT_INLINE void add_energy(const Point<Real>& p, const Real& /*activation*/, Response<Real>& out) const {
    out.energy_Pa += 0.5 * shear_Pa * (p.I1 - 3.0);
  }

  /// Adds stress and tangent without those of volume(), and no energy.
  template <class Real>
  MYOTACT_INLINE void add(const Point<Real>& p, const Real& /*activation*/, Response<Real>& out) const {
    const Real scale = constant<Real>(shear_Pa);
    for (std::size_t k = 0; k < 9; ++k) out.P[k] += scale * p.F[k];
    add_unit(scale, out.C);
  }

  /// The volume term U(J), U', U''.
  template <class Real>
  MYOTACT_INLINE VolumeTerm<Real> volume(const Real& J) const {
    const PositiveRatio<Real> ratio = positive_ratio(J);
    const Real log_j = logarithm(ratio.j), inverse = 1.0 / ratio.j;
    return through<Real>(ratio, {(0.5 * lambda_Pa * log_j - shear_Pa) * log_j, (lambda_Pa * log_j - shear_Pa) * inverse,
                                 (lambda_Pa * (1.0 - log_j) + shear_Pa) * inverse * inverse});
  }
};

}  // namespace myotact::simulation
