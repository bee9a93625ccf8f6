#pragma once

#include <Eigen/LU>
#include <Eigen/SVD>

#include "core/vector.h"
#include "simulation/material/point.h"

namespace myotact::simulation {

namespace detail {

/// Rotation of the polar decomposition with det = +1 also where F is inverted or collapsed, from the singular values.
inline Matrix3<double> rotation_by_singular_values(const Matrix3<double>& F) {
  Mat3 matrix;
  for (int k = 0; k < 9; ++k) matrix(k / 3, k % 3) = F[static_cast<std::size_t>(k)];
  const Eigen::JacobiSVD<Mat3> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0.0) u.col(2) *= -1.0;
  const Mat3 rotation = u * svd.matrixV().transpose();
  Matrix3<double> out;
  for (int k = 0; k < 9; ++k) out[static_cast<std::size_t>(k)] = rotation(k / 3, k % 3);
  return out;
}

/// Below this volume ratio Newton's iteration would be too slow, or find a reflection.
inline constexpr double kSafeRatio = 0.05;
/// Scaled steps bring every F with J >= kSafeRatio whose entries stay below 10 close to its rotation, plain ones then
/// double the digits (measured against the singular values: 1e-15).
inline constexpr int kScaledSteps = 4, kPlainSteps = 3;

/// R of F = R S by Newton's iteration R <- (g R + R^-T / g) / 2 (Higham 1986).
template <class Real>
MYOTACT_INLINE Matrix3<Real> polar_rotation(const Point<Real>& p) {
  Matrix3<Real> R = p.F;
  for (int step = 0; step < kScaledSteps + kPlainSteps; ++step) {
    const Point<Real> at = make_point<Real>(R, {});
    const Real inverse_J = 1.0 / at.J;
    Real keep = constant<Real>(0.5), cofactor_share = 0.5 * inverse_J;
    if (step < kScaledSteps) {
      Real cofactor_squared{};
      for (std::size_t k = 0; k < 9; ++k) cofactor_squared += at.cofactor[k] * at.cofactor[k];
      const Real g = square_root(square_root(cofactor_squared / at.I1) * larger(inverse_J, -inverse_J));
      keep = 0.5 * g;
      cofactor_share = cofactor_share / g;
    }
    for (std::size_t k = 0; k < 9; ++k) R[k] = keep * R[k] + cofactor_share * at.cofactor[k];
  }
  if constexpr (kWidth<Real> == 1) {
    return p.J < kSafeRatio ? rotation_by_singular_values(p.F) : R;
  } else {
    for (int lane = 0; lane < kWidth<Real>; ++lane) {
      if (!(p.J[lane] < kSafeRatio)) continue;
      Matrix3<double> F;
      for (std::size_t k = 0; k < 9; ++k) F[k] = p.F[k][lane];
      const Matrix3<double> rotation = rotation_by_singular_values(F);
      for (std::size_t k = 0; k < 9; ++k) R[k][lane] = rotation[k];
    }
    return R;
  }
}

}  // namespace detail

/// Fixed corotated linear law, for comparison with other programs: W = mu |F - R|^2 + lambda/2 (tr S - 3)^2, F = R S.
/// Its volume term is not a function of J, so an element's mean-volume remedy does not touch it.
struct Corotated {
  double shear_Pa = 0.0;   // mu
  double lambda_Pa = 0.0;  // lambda

  /// Adds the energy without that of volume(). `activation` 0 .. 1.
  template <class Real>
  MYOTACT_INLINE void add_energy(const Point<Real>& p, const Real& /*activation*/, Response<Real>& out) const {
    const Matrix3<Real> R = detail::polar_rotation(p);
    Real trace = constant<Real>(-3.0), squared{};
    for (std::size_t k = 0; k < 9; ++k) {
      trace += R[k] * p.F[k];
      squared += (p.F[k] - R[k]) * (p.F[k] - R[k]);
    }
    out.energy_Pa += shear_Pa * squared + 0.5 * lambda_Pa * trace * trace;
  }

  /// Adds stress and tangent without those of volume(), and no energy.
  template <class Real>
  MYOTACT_INLINE void add(const Point<Real>& p, const Real& /*activation*/, Response<Real>& out) const {
    const Matrix3<Real> R = detail::polar_rotation(p);
    Matrix3<Real> S{};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        for (std::size_t k = 0; k < 3; ++k) S[3 * i + j] += R[3 * k + i] * p.F[3 * k + j];
      }
    }
    const Real trace = S[0] + S[4] + S[8];
    const Real pressure = lambda_Pa * (trace - 3.0);
    for (std::size_t k = 0; k < 9; ++k) out.P[k] += 2.0 * shear_Pa * (p.F[k] - R[k]) + pressure * R[k];
    add_unit(constant<Real>(2.0 * shear_Pa), out.C);
    add_outer(R, constant<Real>(lambda_Pa), out.C);
    add_rotation_slope(R, S, trace, pressure - 2.0 * shear_Pa, out);
  }

  /// Zero: there is none.
  template <class Real>
  MYOTACT_INLINE VolumeTerm<Real> volume(const Real& /*J*/) const {
    return {};
  }

 private:
  /// C += scale dR/dF = scale sum_kl A_kl T_k (x) T_l, T_k = R [e_k]x, A = (tr S 1 - S)^-1.
  template <class Real>
  MYOTACT_INLINE static void add_rotation_slope(const Matrix3<Real>& R, const Matrix3<Real>& S, const Real& trace,
                                                const Real& scale, Response<Real>& out) {
    Matrix3<Real> gap;
    for (std::size_t k = 0; k < 9; ++k) gap[k] = -0.5 * (S[k] + S[3 * (k % 3) + k / 3]);
    for (std::size_t k = 0; k < 9; k += 4) gap[k] += trace;
    const Point<Real> inverse = make_point<Real>(gap, {});
    // A pair of stretches that cancel would let the rotation jump.
    constexpr double kSmallest = 1e-6;
    const Real size =
        each(inverse.J, [](double J) { return std::abs(J) < kSmallest ? std::copysign(kSmallest, J) : J; });
    std::array<Matrix3<Real>, 3> T{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;  // [e_k]x: +1 at (b, a), -1 at (a, b)
      for (std::size_t i = 0; i < 3; ++i) {
        T[k][3 * i + a] = R[3 * i + b];
        T[k][3 * i + b] = -R[3 * i + a];
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      add_outer<Real>(T[k], scale * inverse.cofactor[4 * k] / size, out.C);
      for (std::size_t l = k + 1; l < 3; ++l) {
        add_mixed<Real>(T[k], T[l], scale * inverse.cofactor[3 * k + l] / size, out.C);
      }
    }
  }
};

}  // namespace myotact::simulation
