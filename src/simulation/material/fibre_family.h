#pragma once

#include <algorithm>
#include <concepts>

#include "simulation/material/isochoric.h"

namespace myotact::simulation {

/// Shortest stretch at which fibre terms are evaluated; below, a fibre would divide by zero. The stress goes on as if
/// the fibre had this stretch.
inline constexpr double kShortestStretch = 0.05;

/// Nominal stress of a fibre (force over section at rest) and its slope against the stretch.
struct FibreLaw {
  double stress_Pa = 0.0;
  double slope_Pa = 0.0;
};

/// A curve gives the nominal stress of a fibre: FibreLaw at(stretch, activation), and energy_Pa(stretch, activation),
/// the integral of the stress from stretch 1. Both are asked for stretches from kShortestStretch on.
template <class Curve>
concept FibreCurve = requires(const Curve& curve, double stretch, double activation) {
  { curve.at(stretch, activation) } -> std::same_as<FibreLaw>;
  { curve.energy_Pa(stretch, activation) } -> std::same_as<double>;
};

/// Integral of a curve's stress from stretch 1 by Gauss-Legendre quadrature over panels of 0.02 and what is left: for
/// curves without a primitive. Right to about 1e-12 of the largest stress for smooth curves, 1e-4 beside a kink.
template <class Curve>
double integrate_stress(const Curve& curve, double stretch, double activation) {
  constexpr double kPanel = 0.02;
  constexpr std::array<double, 4> node{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                       0.8611363115940526};
  constexpr std::array<double, 4> weight{0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                         0.3478548451374538};
  const int panels = static_cast<int>(std::abs(stretch - 1.0) / kPanel);
  const double width = std::copysign(kPanel, stretch - 1.0);
  double sum = 0.0;
  for (int k = 0; k <= panels; ++k) {
    const double from = 1.0 + k * width, to = k < panels ? from + width : stretch;
    for (std::size_t g = 0; g < 4; ++g) {
      const double at = 0.5 * (from + to) + 0.5 * (to - from) * node[g];
      sum += 0.5 * (to - from) * weight[g] * curve.at(at, activation).stress_Pa;
    }
  }
  return sum;
}

/// Which stretch a fibre feels: that of the whole deformation, or that of its part without change of volume (FEBio's
/// and ArtiSynth's uncoupled laws).
enum class FibreStretch { Unsplit, Isochoric };

namespace detail {

/// Slopes of w(sqrt(I4)) against I4 (or its isochoric value), from the law at the stretch.
template <class Real>
struct FibreSlopes {
  Real first{}, second{};
};

/// `law(stretch, lane)` gives the FibreLaw of one lane.
template <class Real, class Law>
MYOTACT_INLINE FibreSlopes<Real> fibre_slopes(const Real& I4, const Law& law) {
  const Real stretch = larger(square_root(I4), constant<Real>(kShortestStretch));
  Real stress, slope;
  if constexpr (kWidth<Real> == 1) {
    const FibreLaw value = law(stretch, 0);
    stress = value.stress_Pa;
    slope = value.slope_Pa;
  } else {
    for (int lane = 0; lane < kWidth<Real>; ++lane) {
      const FibreLaw value = law(stretch[lane], lane);
      stress[lane] = value.stress_Pa;
      slope[lane] = value.slope_Pa;
    }
  }
  const Real ratio = stress / stretch;
  const Real moves = where_less(I4, constant<Real>(kShortestStretch * kShortestStretch), Real{}, slope - ratio);
  return {0.5 * ratio, 0.25 * moves / (stretch * stretch)};
}

}  // namespace detail

/// Fibres of one direction: an energy of their stretch alone. A law as in law.h; has no volume term.
template <FibreCurve Curve, FibreStretch kStretch>
struct FibreFamily {
  Curve curve;  // nominal stress by the stretch

  /// What the fibres take of the deformation.
  static constexpr Uses kUses{.J = kStretch == FibreStretch::Isochoric, .I4 = true};

  /// Adds the energy without that of volume(). `activation` 0 .. 1. Real is double here.
  template <class Real>
  MYOTACT_INLINE void add_energy(const Point<Real>& p, const Real& activation, Response<Real>& out) const {
    Real I4 = p.I4;
    if constexpr (kStretch == FibreStretch::Isochoric) I4 = isochoric_values(invariants_of<Real, kUses>(p)).values[kI4];
    const double stretch = std::max(std::sqrt(I4), kShortestStretch);
    out.energy_Pa += curve.energy_Pa(stretch, activation);
    // Below the shortest stretch the slope against I4 stays.
    const double below = std::min(0.0, I4 - kShortestStretch * kShortestStretch);
    out.energy_Pa += below * 0.5 * curve.at(stretch, activation).stress_Pa / stretch;
  }

  /// Adds stress and tangent without those of volume(), and no energy.
  template <class Real>
  MYOTACT_INLINE void add(const Point<Real>& p, const Real& activation, Response<Real>& out) const {
    const auto law = [&](double stretch, int lane) { return curve.at(stretch, lane_of(activation, lane)); };
    Slopes<Real> slopes;
    if constexpr (kStretch == FibreStretch::Unsplit) {
      const detail::FibreSlopes<Real> s = detail::fibre_slopes(p.I4, law);
      slopes.first[kI4] = s.first;
      slopes.second[kI4][kI4] = s.second;
      add_slopes<Real, kUses>(p, slopes, out);
    } else {
      const IsochoricValues<Real> bar = isochoric_values(invariants_of<Real, kUses>(p));
      const detail::FibreSlopes<Real> s = detail::fibre_slopes(bar.values[kI4], law);
      slopes.first[kI4] = s.first;
      slopes.second[kI4][kI4] = s.second;
      add_slopes<Real, kUses>(p, from_isochoric(slopes, bar.values, bar.scale, bar.ratio), out);
    }
  }

  /// Zero: there is none.
  template <class Real>
  MYOTACT_INLINE VolumeTerm<Real> volume(const Real& /*J*/) const {
    return {};
  }
};

}  // namespace myotact::simulation
