#pragma once

#include <array>

#include "simulation/element/pair_terms.h"
#include "simulation/material/point.h"

// The arithmetic of one tet, or of eight side by side: from node positions to deformed points, and from the material's
// response at the points to nodal forces and stiffness. No allocation.
//
// Everything here is inlined, the lambdas too (see MYOTACT_INLINE).
//
// With the gradients g_m of the barycentric coordinates, the slope of a shape function is sum_m s_m g_m with numbers
// s_m that all elements share. So the material's tangent is first brought to the coordinates, B_mn = g_m . C . g_n (3 x
// 3 blocks), and a pair of nodes sums a few of those blocks.

namespace myotact::simulation {

/// What does not change while an element moves.
template <class Real>
struct TetShape {
  std::array<Vector3<Real>, 4> gradient_1_m{};  // of the barycentric coordinates
  Real volume_m3{};                             // at rest
  Vector3<Real> fibre{};                        // unit direction at rest, or zero
};

/// A vector of each node.
template <class Real, class Tet>
using TetNodeVectors = std::array<Vector3<Real>, Tet::kNodes>;
/// 3 x 3 blocks of the pairs of nodes a <= b, row-major.
template <class Real, class Tet>
using TetBlocks = std::array<Matrix3<Real>, kPairs<Tet>>;

/// Deformation at the integration points, from the node positions (world).
template <class Tet, class Real>
MYOTACT_INLINE void deform_tet(const TetShape<Real>& shape, const TetNodeVectors<Real, Tet>& position_m,
                               std::array<Point<Real>, Tet::kPoints>& points) {
  // Of the quadratic functions' slopes against L_m, only the part of one node changes from point to point.
  std::array<Vector3<Real>, 4> common;
  for (std::size_t m = 0; m < 4; ++m) {
    for (std::size_t i = 0; i < 3; ++i) {
      if constexpr (Tet::kNodes == 4) {
        common[m][i] = position_m[m][i];
      } else {
        const auto at = [&](std::size_t q) __attribute__((always_inline)) {
          return position_m[kNodeBetween[m][q]][i];
        };
        common[m][i] = 4.0 * Tet::kNear * ((at(0) + at(1)) + (at(2) + at(3))) - at(m);
      }
    }
  }
  const auto pulled_back = [&](auto&& slope) __attribute__((always_inline)) {
    Matrix3<Real> F;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t A = 0; A < 3; ++A) {
        F[3 * i + A] = (slope(0, i) * shape.gradient_1_m[0][A] + slope(1, i) * shape.gradient_1_m[1][A]) +
                       (slope(2, i) * shape.gradient_1_m[2][A] + slope(3, i) * shape.gradient_1_m[3][A]);
      }
    }
    return F;
  };
  const Matrix3<Real> shared =
      pulled_back([&](std::size_t m, std::size_t i) __attribute__((always_inline)) { return common[m][i]; });
  if constexpr (Tet::kNodes == 4) {
    points[0] = make_point(shared, shape.fibre);
  } else {
    for (std::size_t p = 0; p < Tet::kPoints; ++p) {
      Matrix3<Real> F = pulled_back([&](std::size_t m, std::size_t i)
                                        __attribute__((always_inline)) { return position_m[kNodeBetween[m][p]][i]; });
      for (std::size_t k = 0; k < 9; ++k) F[k] = shared[k] + detail::kBetween * F[k];
      points[p] = make_point(F, shape.fibre);
    }
  }
}

/// force[a] = volume / points * sum over points and A of P_iA dN_a / dX_A (world). `stress`: P of each point.
template <class Tet, class Real>
MYOTACT_INLINE void tet_forces(const TetShape<Real>& shape, const std::array<Matrix3<Real>, Tet::kPoints>& stress,
                               TetNodeVectors<Real, Tet>& force_N) {
  const Real volume = shape.volume_m3 * (1.0 / static_cast<double>(Tet::kPoints));
  std::array<std::array<Vector3<Real>, 4>, Tet::kPoints> pushed;  // [point][coordinate]
  for (std::size_t p = 0; p < Tet::kPoints; ++p) {
    const Matrix3<Real>& P = stress[p];
    for (std::size_t m = 0; m < 4; ++m) {
      const Vector3<Real>& g = shape.gradient_1_m[m];
      for (std::size_t i = 0; i < 3; ++i) {
        pushed[p][m][i] = volume * (P[3 * i] * g[0] + P[3 * i + 1] * g[1] + P[3 * i + 2] * g[2]);
      }
    }
  }
  if constexpr (Tet::kNodes == 4) {
    force_N = pushed[0];
  } else {
    for (std::size_t i = 0; i < 3; ++i) {
      std::array<Real, 4> sum;
      for (std::size_t m = 0; m < 4; ++m) {
        sum[m] = 4.0 * Tet::kNear * ((pushed[0][m][i] + pushed[1][m][i]) + (pushed[2][m][i] + pushed[3][m][i]));
      }
      for (std::size_t m = 0; m < 4; ++m) {
        force_N[m][i] = sum[m] * (1.0 - 0.25 / Tet::kNear) + detail::kBetween * pushed[m][m][i];
        for (std::size_t q = m + 1; q < 4; ++q) {
          force_N[kNodeBetween[m][q]][i] = (sum[m] + sum[q]) + detail::kBetween * (pushed[q][m][i] + pushed[m][q][i]);
        }
      }
    }
  }
}

/// Blocks of the coordinate pairs m <= n, each with its sums (pair_terms.h); for a linear tet one block each.
template <class Real, std::size_t kSums>
using CoordinateBlocks = std::array<std::array<Matrix3<Real>, kSums>, kCoordinatePairs>;

/// Places `sum` of all pairs = scale * g_m . C . g_n.
template <class Real, std::size_t kSums>
MYOTACT_INLINE void coordinate_blocks(const TetShape<Real>& shape, const std::array<Real, kPacked>& C,
                                      const Real& scale, std::size_t sum, CoordinateBlocks<Real, kSums>& B) {
  for (std::size_t n = 1; n < 4; ++n) {
    const Vector3<Real>& g_n = shape.gradient_1_m[n];
    Vector3<Real> scaled;
    for (std::size_t L = 0; L < 3; ++L) scaled[L] = scale * g_n[L];
    std::array<Vector3<Real>, 9> D;
    for (std::size_t r = 0; r < 9; ++r) {
      for (std::size_t k = 0; k < 3; ++k) {
        D[r][k] =
            C[packed(r, 3 * k)] * scaled[0] + C[packed(r, 3 * k + 1)] * scaled[1] + C[packed(r, 3 * k + 2)] * scaled[2];
      }
    }
    for (std::size_t m = 1; m <= n; ++m) {
      const Vector3<Real>& g_m = shape.gradient_1_m[m];
      for (std::size_t e = 0; e < 9; ++e) {
        const std::size_t i = e / 3, k = e % 3;
        B[coordinate_pair(m, n)][sum][e] = g_m[0] * D[3 * i][k] + g_m[1] * D[3 * i + 1][k] + g_m[2] * D[3 * i + 2][k];
      }
    }
  }
  const auto at = [&](std::size_t m, std::size_t n, std::size_t e) __attribute__((always_inline))->const Real& {
    return m <= n ? B[coordinate_pair(m, n)][sum][e] : B[coordinate_pair(n, m)][sum][3 * (e % 3) + e / 3];
  };
  for (std::size_t e = 0; e < 9; ++e) {  // the four gradients sum to zero
    for (std::size_t n = 1; n < 4; ++n) {
      B[coordinate_pair(0, n)][sum][e] = -((at(1, n, e) + at(2, n, e)) + at(3, n, e));
    }
  }
  for (std::size_t e = 0; e < 9; ++e) {
    const std::size_t rotated = 3 * (e % 3) + e / 3;
    B[0][sum][e] = -((at(0, 1, rotated) + at(0, 2, rotated)) + at(0, 3, rotated));
  }
}

/// The tangent C at a point, packed as in point.h.
template <class Real>
using PackedTangent = std::array<Real, kPacked>;

/// tet_stiffness() of a quadratic tet.
template <class Real>
MYOTACT_INLINE void quadratic_stiffness(const TetShape<Real>& shape, const std::array<PackedTangent<Real>, 4>& C,
                                        TetBlocks<Real, QuadraticTet>& blocks_N_m) {
  CoordinateBlocks<Real, kSumsPerPair> B;
  const Real volume = shape.volume_m3 * 0.25;
  for (std::size_t p = 0; p < 4; ++p) coordinate_blocks(shape, C[p], volume, p, B);
  for (std::size_t pair = 0; pair < kCoordinatePairs; ++pair) {
    for (std::size_t e = 0; e < 9; ++e) {
      const Real sum = (B[pair][0][e] + B[pair][1][e]) + (B[pair][2][e] + B[pair][3][e]);
      B[pair][4][e] = sum;
      const Real share = detail::kOfSum * sum;
      for (std::size_t p = 0; p < 4; ++p) B[pair][p][e] = detail::kOfPoint * B[pair][p][e] + share;
    }
  }
  const Matrix3<Real>* block = &B[0][0];
  for (std::size_t pair = 0; pair < kPairs<QuadraticTet>; ++pair) {
    Matrix3<Real> sum{};
    for (std::size_t t = kPairTerms.start[2 * pair + 1]; t < kPairTerms.start[2 * pair + 2]; ++t) {
      const PairTerm& term = kPairTerms.terms[t];
#pragma GCC unroll 9
      for (std::size_t e = 0; e < 9; ++e) sum[e] += term.factor * block[term.block][e];
    }
    sum = {sum[0], sum[3], sum[6], sum[1], sum[4], sum[7], sum[2], sum[5], sum[8]};
    for (std::size_t t = kPairTerms.start[2 * pair]; t < kPairTerms.start[2 * pair + 1]; ++t) {
      const PairTerm& term = kPairTerms.terms[t];
#pragma GCC unroll 9
      for (std::size_t e = 0; e < 9; ++e) sum[e] += term.factor * block[term.block][e];
    }
    blocks_N_m[pair] = sum;
  }
}

/// Stiffness of the pairs of nodes from the tangents at the points.
template <class Tet, class Real>
MYOTACT_INLINE void tet_stiffness(const TetShape<Real>& shape, const std::array<PackedTangent<Real>, Tet::kPoints>& C,
                                  TetBlocks<Real, Tet>& blocks_N_m) {
  if constexpr (Tet::kNodes == 4) {
    CoordinateBlocks<Real, 1> B;
    coordinate_blocks(shape, C[0], shape.volume_m3, 0, B);
    for (std::size_t pair = 0; pair < kCoordinatePairs; ++pair) blocks_N_m[pair] = B[pair][0];
  } else {
    quadratic_stiffness(shape, C, blocks_N_m);
  }
}

/// blocks += scale v_a (x) v_b.
template <class Tet, class Real>
MYOTACT_INLINE void add_outer_blocks(const TetNodeVectors<Real, Tet>& v, const Real& scale,
                                     TetBlocks<Real, Tet>& blocks) {
  std::size_t pair = 0;
  for (std::size_t a = 0; a < Tet::kNodes; ++a) {
    Vector3<Real> scaled;
    for (std::size_t i = 0; i < 3; ++i) scaled[i] = scale * v[a][i];
    for (std::size_t b = a; b < Tet::kNodes; ++b, ++pair) {
      for (std::size_t e = 0; e < 9; ++e) blocks[pair][e] += scaled[e / 3] * v[b][e % 3];
    }
  }
}

/// Where a point of a solid counts as folding over, unless it says otherwise.
inline constexpr double kFoldedJ = 0.05;

/// The volume term on the element's mean volume ratio, plus c/2 (J - mean J)^2 at each point.
template <class Real>
struct MeanVolume {
  Real mean_J{};            // of the element
  VolumeTerm<Real> term{};  // at mean_J
  Real fluctuation_Pa{};    // c
};

/// What a point adds to the volume term of the mean. Below `folded_J` it is pushed back by its own volume term too: the
/// mean alone lets points fold over and rest there.
template <class Real>
MYOTACT_INLINE VolumeTerm<Real> point_volume(const MeanVolume<Real>& mean, const Real& J, double folded_J = kFoldedJ) {
  const Real gap = J - mean.mean_J, low = constant<Real>(folded_J);
  const Real folded = where_less(J, low, J - low, Real{});
  const Real stiff = where_less(J, low, mean.term.curvature_Pa, Real{});
  return {0.5 * (mean.fluctuation_Pa * gap * gap + stiff * folded * folded), mean.fluctuation_Pa * gap + stiff * folded,
          mean.fluctuation_Pa + stiff};
}

/// Adds to the responses at the points. The stiffness also needs (U'' - c) of the mean volume ratio's slope with
/// itself.
template <class Real>
MYOTACT_INLINE void add_mean_volume(const std::array<Point<Real>, QuadraticTet::kPoints>& points,
                                    const MeanVolume<Real>& volume,
                                    std::array<Response<Real>, QuadraticTet::kPoints>& responses) {
  for (std::size_t p = 0; p < QuadraticTet::kPoints; ++p) {
    const VolumeTerm<Real> own = point_volume(volume, points[p].J);
    add_volume<Real>(points[p],
                     {volume.term.energy_Pa + own.energy_Pa, volume.term.slope_Pa + own.slope_Pa, own.curvature_Pa},
                     responses[p]);
  }
}

}  // namespace myotact::simulation
