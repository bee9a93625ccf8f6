#pragma once

#include <array>

#include "simulation/simd/lanes.h"

// The input of a material law at a point of the tissue, and its result. 3x3 matrices are row-major: entry 3 i + A has
// the component i in the world and the direction A of the rest position.

namespace myotact::simulation {

/// Real is a double, several side by side (lanes.h) or Eight.
template <class Real>
using Vector3 = std::array<Real, 3>;
template <class Real>
using Matrix3 = std::array<Real, 9>;

/// Place of entry (row, column) of a symmetric 9 x 9 matrix in its packed upper triangle.
constexpr std::size_t packed(std::size_t row, std::size_t column) {
  const std::size_t low = row < column ? row : column, high = row < column ? column : row;
  return low * 9 - low * (low + 1) / 2 + high;
}
/// Entries of that triangle.
inline constexpr std::size_t kPacked = 45;

/// A deformed point.
template <class Real>
struct Point {
  Matrix3<Real> F{};         // deformation gradient
  Matrix3<Real> cofactor{};  // dJ/dF
  Real J{};                  // det F, the volume ratio
  Real I1{};                 // F : F
  Vector3<Real> fibre{};     // unit direction at rest, or zero
  Vector3<Real> f{};         // F fibre
  Real I4{};                 // |F fibre|^2
};

/// Energy and its derivatives against F: nominal stress P [Pa] and its slope C [Pa], packed.
template <class Real>
struct Response {
  Real energy_Pa{};
  Matrix3<Real> P{};
  std::array<Real, kPacked> C{};
};

/// Term of the volume ratio alone: U(J), U', U''.
template <class Real>
struct VolumeTerm {
  Real energy_Pa{}, slope_Pa{}, curvature_Pa{};
};

/// a x b, three numbers each.
template <class Real>
MYOTACT_INLINE Vector3<Real> cross(const Real* a, const Real* b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// What follows from F; `fibre` of unit length at rest, or zero.
template <class Real>
MYOTACT_INLINE Point<Real> make_point(const Matrix3<Real>& F, const Vector3<Real>& fibre) {
  Point<Real> point;
  point.F = F;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3<Real> row = cross(&F[3 * ((i + 1) % 3)], &F[3 * ((i + 2) % 3)]);
    for (std::size_t A = 0; A < 3; ++A) point.cofactor[3 * i + A] = row[A];
  }
  point.J = F[0] * point.cofactor[0] + F[1] * point.cofactor[1] + F[2] * point.cofactor[2];
  for (std::size_t k = 0; k < 9; ++k) point.I1 = point.I1 + F[k] * F[k];
  point.fibre = fibre;
  for (std::size_t i = 0; i < 3; ++i) {
    point.f[i] = F[3 * i] * fibre[0] + F[3 * i + 1] * fibre[1] + F[3 * i + 2] * fibre[2];
    point.I4 = point.I4 + point.f[i] * point.f[i];
  }
  return point;
}

/// C += scale a (x) a.
template <class Real>
MYOTACT_INLINE void add_outer(const Matrix3<Real>& a, const Real& scale, std::array<Real, kPacked>& C) {
  for (std::size_t r = 0; r < 9; ++r) {
    const Real left = scale * a[r];
    for (std::size_t c = r; c < 9; ++c) C[packed(r, c)] += left * a[c];
  }
}

/// C += scale (a (x) b + b (x) a).
template <class Real>
MYOTACT_INLINE void add_mixed(const Matrix3<Real>& a, const Matrix3<Real>& b, const Real& scale,
                              std::array<Real, kPacked>& C) {
  for (std::size_t r = 0; r < 9; ++r) {
    for (std::size_t c = r; c < 9; ++c) C[packed(r, c)] += scale * (a[r] * b[c] + b[r] * a[c]);
  }
}

/// C += scale times the unit matrix.
template <class Real>
MYOTACT_INLINE void add_unit(const Real& scale, std::array<Real, kPacked>& C) {
  for (std::size_t k = 0; k < 9; ++k) C[packed(k, k)] += scale;
}

/// C += scale d2J/dF2, which holds the entries of F: d2J/dF_iA dF_jB = eps_ijk eps_ABC F_kC.
template <class Real>
MYOTACT_INLINE void add_volume_curvature(const Matrix3<Real>& F, const Real& scale, std::array<Real, kPacked>& C) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    for (std::size_t A = 0; A < 3; ++A) {
      const std::size_t B = (A + 1) % 3, D = (A + 2) % 3;
      const Real value = scale * F[3 * k + D];
      C[packed(3 * i + A, 3 * j + B)] += value;
      C[packed(3 * i + B, 3 * j + A)] -= value;
    }
  }
}

/// A term of the volume ratio acts at a point: adds its energy, stress and tangent.
template <class Real>
MYOTACT_INLINE void add_volume(const Point<Real>& point, const VolumeTerm<Real>& volume, Response<Real>& response) {
  response.energy_Pa += volume.energy_Pa;
  for (std::size_t k = 0; k < 9; ++k) response.P[k] += volume.slope_Pa * point.cofactor[k];
  add_outer(point.cofactor, volume.curvature_Pa, response.C);
  add_volume_curvature(point.F, volume.slope_Pa, response.C);
}

}  // namespace myotact::simulation
