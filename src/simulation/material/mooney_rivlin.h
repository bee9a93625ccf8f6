#pragma once

#include "simulation/material/isochoric.h"

namespace myotact::simulation {

/// Uncoupled Mooney-Rivlin law: W = c1 (J^(-2/3) I1 - 3) + c2 (J^(-4/3) I2 - 3) + K/2 (ln J)^2.
struct MooneyRivlin {
  double c1_Pa = 0.0;
  double c2_Pa = 0.0;
  double bulk_Pa = 0.0;  // K

  /// What the law takes of the deformation.
  static constexpr Uses kUses{.I1 = true, .I2 = true, .J = true};

  /// Adds the energy without that of volume(). `activation` 0 .. 1.
  template <class Real>
  MYOTACT_INLINE void add_energy(const Point<Real>& p, const Real& /*activation*/, Response<Real>& out) const {
    const IsochoricValues<Real> bar = isochoric_values(invariants_of<Real, kUses>(p));
    out.energy_Pa += c1_Pa * (bar.values[kI1] - 3.0) + c2_Pa * (bar.values[kI2] - 3.0);
  }

  /// Adds stress and tangent without those of volume(), and no energy.
  template <class Real>
  MYOTACT_INLINE void add(const Point<Real>& p, const Real& /*activation*/, Response<Real>& out) const {
    const IsochoricValues<Real> bar = isochoric_values(invariants_of<Real, kUses>(p));
    Slopes<Real> slopes;
    slopes.first[kI1] = constant<Real>(c1_Pa);
    slopes.first[kI2] = constant<Real>(c2_Pa);
    add_slopes<Real, kUses>(p, from_isochoric(slopes, bar.values, bar.scale, bar.ratio), out);
  }

  /// The volume term U(J), U', U''.
  template <class Real>
  MYOTACT_INLINE VolumeTerm<Real> volume(const Real& J) const {
    return logarithmic_volume(bulk_Pa, J);
  }
};

}  // namespace myotact::simulation
