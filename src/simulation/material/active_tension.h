#pragma once

#include "simulation/material/fibre_family.h"

namespace myotact::simulation {

/// A curve for FibreFamily: a fibre of constant second Piola-Kirchhoff stress, the activation times T0, so that its
/// Cauchy stress is T0 stretch^2 / J: W = a T0 / 2 (stretch^2 - 1). FEBio's prescribed uniaxial contraction.
struct ConstantTension {
  double tension_Pa = 0.0;  // T0

  /// Nominal stress and its slope; its integral from stretch 1. `activation` 0 .. 1, stretch > 0.
  FibreLaw at(double stretch, double activation) const {
    const double modulus = activation * tension_Pa;
    return {modulus * stretch, modulus};
  }
  double energy_Pa(double stretch, double activation) const {
    return 0.5 * activation * tension_Pa * (stretch * stretch - 1.0);
  }
};

/// Contraction without a direction, sigma = a T0 B / J: W = a T0 / 2 (I1 - 3). FEBio's prescribed isotropic
/// contraction.
struct IsotropicTension {
  double tension_Pa = 0.0;  // T0

  /// Adds the energy without that of volume(). `activation` 0 .. 1.
  template <class Real>
  MYOTACT_INLINE void add_energy(const Point<Real>& p, const Real& activation, Response<Real>& out) const {
    out.energy_Pa += 0.5 * tension_Pa * activation * (p.I1 - 3.0);
  }

  /// Adds stress and tangent without those of volume(), and no energy.
  template <class Real>
  MYOTACT_INLINE void add(const Point<Real>& p, const Real& activation, Response<Real>& out) const {
    const Real scale = tension_Pa * activation;
    for (std::size_t k = 0; k < 9; ++k) out.P[k] += scale * p.F[k];
    add_unit(scale, out.C);
  }

  /// Zero: there is none.
  template <class Real>
  MYOTACT_INLINE VolumeTerm<Real> volume(const Real& /*J*/) const {
    return {};
  }
};

/// Heart muscle at a calcium concentration (Guccione and McCulloch, J Biomech Eng 115:72, 1993), as in FEBio's
/// "trans iso" materials: tension T = Tmax ca0^2 / (ca0^2 + ECa50^2), ECa50 = camax / sqrt(exp(B (l - l0)) - 1),
/// l = refl J^(-1/3) stretch; no tension at or below l0. There T is Cauchy stress and J that of the point, which no
/// energy can give; here J is a number, and where it is the point's J, which takes a few rounds, so is the stress.
struct CalciumTension {
  double largest_Pa = 0.0;                      // Tmax
  double calcium = 0.0, largest_calcium = 0.0;  // ca0, camax; micromole
  double steepness_1_um = 0.0;                  // B
  double shortest_um = 0.0;                     // l0, a sarcomere
  double reference_um = 0.0;                    // refl
  double volume_ratio = 1.0;                    // J

  /// Nominal stress and its slope; its integral from stretch 1. `activation` 0 .. 1, stretch > 0.
  FibreLaw at(double stretch, double activation) const {
    const double length_um = reference_um / std::cbrt(volume_ratio);  // at stretch 1
    const double growth = std::exp(steepness_1_um * (length_um * stretch - shortest_um));
    if (growth <= 1.0) return {};
    const double squared = calcium * calcium * (growth - 1.0), rest = largest_calcium * largest_calcium;
    const double scale = activation * largest_Pa * volume_ratio;
    const double tension = scale * squared / (squared + rest);
    const double rate =
        scale * rest * calcium * calcium * growth * steepness_1_um * length_um / ((squared + rest) * (squared + rest));
    return {tension / stretch, rate / stretch - tension / (stretch * stretch)};
  }
  double energy_Pa(double stretch, double activation) const { return integrate_stress(*this, stretch, activation); }
};

}  // namespace myotact::simulation
