#pragma once

#include "simulation/material/point.h"

// Most laws are functions of a few scalar invariants of the deformation. Such a law states the slopes of its energy
// against them, and what follows for stress and tangent is done here once:
//
//   I1 = F:F      I2 = (I1^2 - |F^T F|^2) / 2      J = det F      I4 = |F a|^2      I5 = |F^T F a|^2

namespace myotact::simulation {

/// Place of each in Invariants, and how many there are.
enum Invariant : std::size_t { kI1, kI2, kJ, kI4, kI5, kInvariants };

/// Values of all, or slopes against all.
template <class Real>
using Invariants = std::array<Real, kInvariants>;

/// Energy with its first and second derivatives against the invariants. Entries of invariants that the law does not
/// use stay zero.
template <class Real>
struct Slopes {
  Real energy_Pa{};
  Invariants<Real> first{};
  std::array<std::array<Real, kInvariants>, kInvariants> second{};  // upper triangle: row <= column
};

/// Laws that divide by the volume ratio or take its logarithm see this instead: J itself down to a tenth, below it a
/// curve that stays positive, with value and slope continuous. An inverted element is thus pushed back
/// by a finite force.
template <class Real>
struct PositiveRatio {
  Real j{}, slope{}, curvature{};  // j(J), j', j''
};
/// Where the curve leaves J.
inline constexpr double kLowestRatio = 0.1;

/// At any finite J.
template <class Real>
MYOTACT_INLINE PositiveRatio<Real> positive_ratio(const Real& J) {
  const Real low = constant<Real>(kLowestRatio), one = constant<Real>(1.0), zero{};
  const Real gap = larger(2.0 * low - J, low);
  const Real bent = low * low / gap;
  const Real slope = bent / gap;
  return {where_less(J, low, bent, J), where_less(J, low, slope, one), where_less(J, low, 2.0 * slope / gap, zero)};
}

/// U(j(J)) from the slopes of U against j.
template <class Real>
MYOTACT_INLINE VolumeTerm<Real> through(const PositiveRatio<Real>& ratio, const VolumeTerm<Real>& of_j) {
  return {of_j.energy_Pa, of_j.slope_Pa * ratio.slope,
          of_j.curvature_Pa * ratio.slope * ratio.slope + of_j.slope_Pa * ratio.curvature};
}

/// bulk / 2 (ln J)^2, J replaced by positive_ratio().
template <class Real>
MYOTACT_INLINE VolumeTerm<Real> logarithmic_volume(double bulk_Pa, const Real& J) {
  const PositiveRatio<Real> ratio = positive_ratio(J);
  const Real log_j = logarithm(ratio.j);
  return through<Real>(
      ratio, {0.5 * bulk_Pa * log_j * log_j, bulk_Pa * log_j / ratio.j, bulk_Pa * (1.0 - log_j) / (ratio.j * ratio.j)});
}

namespace detail {

/// F^T F a, and F F^T F as rows: what the derivatives of I5 and I2 are made of.
template <class Real>
struct Products {
  Matrix3<Real> right{};  // F^T F
  Matrix3<Real> cubed{};  // F F^T F
  Matrix3<Real> left{};   // F F^T
  Vector3<Real> b{};      // F^T F a
  Vector3<Real> g{};      // F F^T F a
};

/// Of a deformed point.
template <class Real>
MYOTACT_INLINE Products<Real> products_of(const Point<Real>& p) {
  Products<Real> out;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) {
        out.right[3 * i + j] += p.F[3 * k + i] * p.F[3 * k + j];
        out.left[3 * i + j] += p.F[3 * i + k] * p.F[3 * j + k];
      }
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) out.cubed[3 * i + j] += p.F[3 * i + k] * out.right[3 * k + j];
      out.b[i] += out.right[3 * i + j] * p.fibre[j];
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t A = 0; A < 3; ++A) out.g[i] += p.F[3 * i + A] * out.b[A];
  }
  return out;
}

/// C += scale (delta_ij s_AB): a matrix of the rest position, the same for every component.
template <class Real>
MYOTACT_INLINE void add_rest_matrix(const Matrix3<Real>& s, const Real& scale, std::array<Real, kPacked>& C) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t A = 0; A < 3; ++A) {
      for (std::size_t B = A; B < 3; ++B) C[packed(3 * i + A, 3 * i + B)] += scale * s[3 * A + B];
    }
  }
}

/// a (x) b, row-major.
template <class Real>
MYOTACT_INLINE Matrix3<Real> outer(const Vector3<Real>& a, const Vector3<Real>& b) {
  Matrix3<Real> product;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t A = 0; A < 3; ++A) product[3 * i + A] = a[i] * b[A];
  }
  return product;
}

/// C += first d2I2/dF2 = 2 first (2 F (x) F + I1 unit - terms of F F^T F).
template <class Real>
MYOTACT_INLINE void add_I2_curvature(const Point<Real>& p, const Products<Real>& q, const Real& first,
                                     std::array<Real, kPacked>& C) {
  add_outer(p.F, 4.0 * first, C);
  add_unit(2.0 * first * p.I1, C);
  add_rest_matrix(q.right, -2.0 * first, C);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t A = 0; A < 3; ++A) {
      for (std::size_t j = 0; j < 3; ++j) {
        for (std::size_t B = 0; B < 3; ++B) {
          const std::size_t r = 3 * i + A, c = 3 * j + B;
          if (r > c) continue;
          C[packed(r, c)] -= 2.0 * first * p.F[3 * i + B] * p.F[3 * j + A];
          if (A == B) C[packed(r, c)] -= 2.0 * first * q.left[3 * i + j];
        }
      }
    }
  }
}

/// dI5/dF_iA = 2 (g_i a_A + f_i b_A); C += first times its slope.
template <class Real>
MYOTACT_INLINE void add_I5_curvature(const Point<Real>& p, const Products<Real>& q, const Real& first,
                                     std::array<Real, kPacked>& C) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t A = 0; A < 3; ++A) {
      for (std::size_t j = 0; j < 3; ++j) {
        for (std::size_t B = 0; B < 3; ++B) {
          const std::size_t r = 3 * i + A, c = 3 * j + B;
          if (r > c) continue;
          Real sum = q.left[3 * i + j] * p.fibre[A] * p.fibre[B] + p.F[3 * i + B] * p.f[j] * p.fibre[A] +
                     p.f[i] * p.F[3 * j + A] * p.fibre[B];
          if (A == B) sum += p.f[i] * p.f[j];
          if (i == j) sum += p.fibre[A] * q.b[B] + q.b[A] * p.fibre[B];
          C[packed(r, c)] += 2.0 * first * sum;
        }
      }
    }
  }
}

}  // namespace detail

/// Which invariants a law uses.
struct Uses {
  bool I1 = false, I2 = false, J = false, I4 = false, I5 = false;
};

/// What a law knows before it states its slopes. I2 and I5 are 0 when neither is used.
template <class Real, Uses kUses>
MYOTACT_INLINE Invariants<Real> invariants_of(const Point<Real>& p) {
  Invariants<Real> inv{};
  inv[kI1] = p.I1;
  inv[kJ] = p.J;
  inv[kI4] = p.I4;
  if constexpr (kUses.I2 || kUses.I5) {
    const detail::Products<Real> q = detail::products_of(p);
    Real squared{};
    for (std::size_t k = 0; k < 9; ++k) squared += q.right[k] * q.right[k];
    inv[kI2] = 0.5 * (p.I1 * p.I1 - squared);
    for (std::size_t i = 0; i < 3; ++i) inv[kI5] += q.b[i] * q.b[i];
  }
  return inv;
}

/// Adds stress and tangent of an energy that is a function of invariants (the energy itself is added apart: it is asked
/// for rarely).
template <class Real, Uses kUses>
MYOTACT_INLINE void add_slopes(const Point<Real>& p, const Slopes<Real>& s, Response<Real>& out) {
  std::array<Matrix3<Real>, kInvariants> gradient{};
  constexpr std::array<bool, kInvariants> used{kUses.I1, kUses.I2, kUses.J, kUses.I4, kUses.I5};
  detail::Products<Real> q;
  if constexpr (kUses.I2 || kUses.I5) q = detail::products_of(p);
  for (std::size_t k = 0; k < 9; ++k) {
    if constexpr (kUses.I1) gradient[kI1][k] = 2.0 * p.F[k];
    if constexpr (kUses.I2) gradient[kI2][k] = 2.0 * (p.I1 * p.F[k] - q.cubed[k]);
    if constexpr (kUses.J) gradient[kJ][k] = p.cofactor[k];
    if constexpr (kUses.I4) gradient[kI4][k] = 2.0 * p.f[k / 3] * p.fibre[k % 3];
    if constexpr (kUses.I5) gradient[kI5][k] = 2.0 * (q.g[k / 3] * p.fibre[k % 3] + p.f[k / 3] * q.b[k % 3]);
  }
  for (std::size_t a = 0; a < kInvariants; ++a) {
    if (!used[a]) continue;
    for (std::size_t k = 0; k < 9; ++k) out.P[k] += s.first[a] * gradient[a][k];
    add_outer(gradient[a], s.second[a][a], out.C);
    for (std::size_t b = a + 1; b < kInvariants; ++b) {
      if (used[b]) add_mixed(gradient[a], gradient[b], s.second[a][b], out.C);
    }
  }
  if constexpr (kUses.I1) add_unit(2.0 * s.first[kI1], out.C);
  if constexpr (kUses.I2) detail::add_I2_curvature(p, q, s.first[kI2], out.C);
  if constexpr (kUses.J) add_volume_curvature(p.F, s.first[kJ], out.C);
  if constexpr (kUses.I4) detail::add_rest_matrix(detail::outer(p.fibre, p.fibre), 2.0 * s.first[kI4], out.C);
  if constexpr (kUses.I5) detail::add_I5_curvature(p, q, s.first[kI5], out.C);
}

}  // namespace myotact::simulation
