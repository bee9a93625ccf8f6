#include "simulation/quadratic_tet.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "geometry/tet_mesh.h"
#include "simulation/vector_clones.h"

namespace myotact::simulation {
namespace {

/// Rows of the low-rank part: shear, volume fluctuation and fibre at each point, and the element's mean volume.
constexpr int kRankRows = 3 * kTetPoints + 1;

constexpr std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

/// Pressure-like factor of the cofactor at a point: L (mean J - rest) + c (J - mean J).
MYOTACT_INTO_CLONES double volume_stress(const TissueMaterial& m, const TetPoints& points, std::size_t p) {
  return m.volume_term_Pa() * (points.mean_J - m.rest_ratio()) + m.fluctuation_Pa * (points.J[p] - points.mean_J);
}

/// out[i * 12 + a] = scale * sum_A matrix(i, A) dN_a/dX_A.
MYOTACT_INTO_CLONES void push_gradients(const std::array<double, 9>& matrix, const TetVector& gradients, double scale,
                                        double* out) {
  for (int i = 0; i < 3; ++i) {
    const double m0 = scale * matrix[at(3 * i)], m1 = scale * matrix[at(3 * i + 1)], m2 = scale * matrix[at(3 * i + 2)];
    for (int a = 0; a < kTetStride; ++a) {
      out[i * kTetStride + a] =
          m0 * gradients[at(a)] + m1 * gradients[at(kTetStride + a)] + m2 * gradients[at(2 * kTetStride + a)];
    }
  }
}

/// out[r * kTetDofs + b] += sum_k left[k * kTetDofs + r] * right[k * RightStride + b] for the 10 nodes r and the 12
/// places b of one pair of components. Two rows at a time are held in registers: six chains of additions keep the
/// adders busy.
template <int Depth, int RightStride>
MYOTACT_INTO_CLONES void add_product(const double* left, const double* right, double* out) {
  for (int r = 0; r < kTetNodes; r += 2) {
    Pack* rows[2] = {reinterpret_cast<Pack*>(out + r * kTetDofs), reinterpret_cast<Pack*>(out + (r + 1) * kTetDofs)};
    Pack sum[2][3] = {{rows[0][0], rows[0][1], rows[0][2]}, {rows[1][0], rows[1][1], rows[1][2]}};
    for (int k = 0; k < Depth; ++k) {
      const Pack* packs = reinterpret_cast<const Pack*>(right + k * RightStride);
      const double first = left[k * kTetDofs + r], second = left[k * kTetDofs + r + 1];
      for (int b = 0; b < 3; ++b) {
        sum[0][b] += first * packs[b];
        sum[1][b] += second * packs[b];
      }
    }
    for (int b = 0; b < 3; ++b) {
      rows[0][b] = sum[0][b];
      rows[1][b] = sum[1][b];
    }
  }
}

MYOTACT_INTO_CLONES double* block_of(TetMatrix& stiffness, int i, int j) {
  return &stiffness[at(i * kTetStride * kTetDofs + j * kTetStride)];
}

struct RankRows {
  std::array<TetVector, kRankRows> row;
  std::array<double, kRankRows> factor;
};

/// Every term of the tangent that is a scaled outer product of a vector with itself.
MYOTACT_INTO_CLONES RankRows rank_rows(const ElementInputs& in, bool definite) {
  RankRows rows;
  const double volume = in.rest.point_volume_m3;
  const double c = in.material.fluctuation_Pa;
  TetVector& mean = rows.row[kRankRows - 1];
  mean.fill(0.0);
  for (int p = 0; p < kTetPoints; ++p) {
    const TetVector& gradients = in.rest.gradients_1_m[at(p)];
    const double ic1 = in.points.F_squared[at(p)] + 1.0;
    push_gradients(in.points.F[at(p)], gradients, 1.0, rows.row[at(3 * p)].data());
    rows.factor[at(3 * p)] = volume * 2.0 * in.material.shear_term_Pa() / (ic1 * ic1);
    push_gradients(in.points.cofactor[at(p)], gradients, 1.0, rows.row[at(3 * p + 1)].data());
    rows.factor[at(3 * p + 1)] = volume * c;
    for (int k = 0; k < kTetDofs; ++k) mean[at(k)] += 0.25 * rows.row[at(3 * p + 1)][at(k)];

    const double geometric = in.stress.stress_Pa[at(p)] / in.points.stretch[at(p)];
    const double slope = in.stress.slope_Pa[at(p)];
    rows.factor[at(3 * p + 2)] =
        volume * (definite ? std::max(slope, 0.0) - std::max(geometric, 0.0) : slope - geometric);
    for (int a = 0; a < kTetStride; ++a) {
      const double along = in.fibre.x() * gradients[at(a)] + in.fibre.y() * gradients[at(kTetStride + a)] +
                           in.fibre.z() * gradients[at(2 * kTetStride + a)];
      for (int i = 0; i < 3; ++i) rows.row[at(3 * p + 2)][at(i * kTetStride + a)] = in.points.fibre[at(p)][i] * along;
    }
  }
  rows.factor[kRankRows - 1] = kTetPoints * volume * (in.material.volume_term_Pa() - c);
  return rows;
}

MYOTACT_INTO_CLONES void add_outer_products(const RankRows& rows, TetMatrix& stiffness) {
  std::array<TetVector, kRankRows> scaled;
  for (std::size_t k = 0; k < kRankRows; ++k) {
    for (std::size_t r = 0; r < kTetDofs; ++r) scaled[k][r] = rows.factor[k] * rows.row[k][r];
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      add_product<kRankRows, kTetDofs>(&scaled[0][at(i * kTetStride)], &rows.row[0][at(j * kTetStride)],
                                       block_of(stiffness, i, j));
    }
  }
}

struct PointScales {
  double identity = 0.0;   // of grad a . grad b
  double along = 0.0;      // of the gradients' fibre components
  double curvature = 0.0;  // of the second derivative of J
};

MYOTACT_INTO_CLONES PointScales point_scales(const ElementInputs& in, int p, bool definite) {
  const double volume = in.rest.point_volume_m3;
  const double f2 = in.points.F_squared[at(p)];
  const double pressure = volume_stress(in.material, in.points, at(p));
  double identity = in.material.shear_term_Pa() * (1.0 - 1.0 / (f2 + 1.0));
  double along = in.stress.stress_Pa[at(p)] / in.points.stretch[at(p)];
  if (definite) {
    // The eigenvalues of d2J/dF2 lie within +-sqrt(4/3 F:F); this much of the identity outweighs them.
    identity = std::max(identity, std::abs(pressure) * std::sqrt(4.0 / 3.0 * f2));
    along = std::max(along, 0.0);
  }
  return {volume * identity, volume * along, volume * pressure};
}

/// One row a point and direction A of the rest position.
using SlopeRows = std::array<TetVector, 3 * kTetPoints>;

/// left[A] of `unit_rows` and `skew_rows` at point p for all nodes a: what dN_b/dX_A is multiplied with.
MYOTACT_INTO_CLONES void slope_rows(const ElementInputs& in, int p, const PointScales& scale, SlopeRows& unit_rows,
                                    SlopeRows& skew_rows) {
  const TetVector& g = in.rest.gradients_1_m[at(p)];
  const std::array<double, 9>& F = in.points.F[at(p)];
  const double* fibre = in.fibre.data();
  std::array<double, kTetStride> along;
  for (std::size_t a = 0; a < kTetStride; ++a) {
    along[a] = scale.along * (g[a] * fibre[0] + g[kTetStride + a] * fibre[1] + g[2 * kTetStride + a] * fibre[2]);
  }
  for (int A = 0; A < 3; ++A) {
    const int B = (A + 1) % 3, C = (A + 2) % 3;
    TetVector& unit = unit_rows[at(3 * p + A)];
    TetVector& skew = skew_rows[at(3 * p + A)];
    const double *g_A = &g[at(A * kTetStride)], *g_B = &g[at(B * kTetStride)], *g_C = &g[at(C * kTetStride)];
    for (std::size_t a = 0; a < kTetStride; ++a) unit[a] = scale.identity * g_A[a] + along[a] * fibre[A];
    // Row i of F times the cross-product matrix of grad a: (F_i x grad a) . grad b.
    for (int i = 0; i < 3; ++i) {
      const double factor = i == 1 ? -scale.curvature : scale.curvature;  // eps_021 = -1
      const double F_B = factor * F[at(3 * i + B)], F_C = factor * F[at(3 * i + C)];
      for (int a = 0; a < kTetStride; ++a) skew[at(i * kTetStride + a)] = F_B * g_C[a] - F_C * g_B[a];
    }
  }
}

/// Writes the terms that are a multiple of the unit matrix (same in every component block) and the skew terms of the
/// second derivative of J: block (i, j) gets eps_ijk v_k, v = F (grad a x grad b).
MYOTACT_INTO_CLONES void fill_slope_products(const ElementInputs& in, bool definite, TetMatrix& stiffness) {
  SlopeRows unit_rows, skew_rows;
  for (int p = 0; p < kTetPoints; ++p) slope_rows(in, p, point_scales(in, p, definite), unit_rows, skew_rows);
  const double* slopes = in.rest.gradients_1_m[0].data();
  stiffness.fill(0.0);
  add_product<3 * kTetPoints, kTetStride>(unit_rows[0].data(), slopes, block_of(stiffness, 0, 0));
  for (int i = 1; i < 3; ++i) {
    for (int a = 0; a < kTetNodes; ++a) {
      std::copy_n(block_of(stiffness, 0, 0) + a * kTetDofs, kTetStride, block_of(stiffness, i, i) + a * kTetDofs);
    }
  }
  const auto skew = [&](int component) { return &skew_rows[0][at(component * kTetStride)]; };
  add_product<3 * kTetPoints, kTetStride>(skew(2), slopes, block_of(stiffness, 0, 1));
  add_product<3 * kTetPoints, kTetStride>(skew(1), slopes, block_of(stiffness, 0, 2));
  add_product<3 * kTetPoints, kTetStride>(skew(0), slopes, block_of(stiffness, 1, 2));
}

}  // namespace

TetRest make_tet_rest(const std::array<Vec3, 4>& corners_m) {
  Mat3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = corners_m[at(k + 1)] - corners_m[0];
  const Mat3 inverse = edges.inverse();
  std::array<Vec3, 4> slopes;  // of the barycentric coordinates
  for (int k = 0; k < 3; ++k) slopes[at(k + 1)] = inverse.row(k).transpose();
  slopes[0] = -(slopes[1] + slopes[2] + slopes[3]);

  // The 4-point rule of degree 2: each point has one coordinate `far` and three `near`.
  const double far = (5.0 + 3.0 * std::sqrt(5.0)) / 20.0;
  const double near = (5.0 - std::sqrt(5.0)) / 20.0;
  TetRest rest;
  rest.point_volume_m3 = edges.determinant() / 6.0 / kTetPoints;
  for (int p = 0; p < kTetPoints; ++p) {
    const auto coordinate = [&](int corner) { return corner == p ? far : near; };
    std::array<Vec3, kTetNodes> gradient;
    for (int a = 0; a < 4; ++a) gradient[at(a)] = (4.0 * coordinate(a) - 1.0) * slopes[at(a)];
    for (std::size_t e = 0; e < geometry::kTetEdges.size(); ++e) {
      const auto [i, j] = geometry::kTetEdges[e];
      gradient[4 + e] = 4.0 * (coordinate(i) * slopes[at(j)] + coordinate(j) * slopes[at(i)]);
    }
    for (int a = 0; a < kTetNodes; ++a) {
      for (int A = 0; A < 3; ++A) rest.gradients_1_m[at(p)][at(A * kTetStride + a)] = gradient[at(a)][A];
    }
  }
  return rest;
}

MYOTACT_VECTOR_CLONES
void deform(const TetRest& rest, const Vec3& fibre, const TetVector& position_m, TetPoints& points) {
  points.mean_J = 0.0;
  for (int p = 0; p < kTetPoints; ++p) {
    std::array<double, 9>& F = points.F[at(p)];
    for (int i = 0; i < 3; ++i) {
      const Pack* x = reinterpret_cast<const Pack*>(&position_m[at(i * kTetStride)]);
      for (int A = 0; A < 3; ++A) {
        const Pack* g = reinterpret_cast<const Pack*>(&rest.gradients_1_m[at(p)][at(A * kTetStride)]);
        const Pack sum = x[0] * g[0] + x[1] * g[1] + x[2] * g[2];
        F[at(3 * i + A)] = (sum[0] + sum[1]) + (sum[2] + sum[3]);
      }
    }
    const Vec3 r0(F[0], F[1], F[2]), r1(F[3], F[4], F[5]), r2(F[6], F[7], F[8]);
    const Vec3 c0 = r1.cross(r2), c1 = r2.cross(r0), c2 = r0.cross(r1);
    points.cofactor[at(p)] = {c0[0], c0[1], c0[2], c1[0], c1[1], c1[2], c2[0], c2[1], c2[2]};
    points.J[at(p)] = r0.dot(c0);
    points.mean_J += points.J[at(p)] / kTetPoints;
    points.F_squared[at(p)] = r0.squaredNorm() + r1.squaredNorm() + r2.squaredNorm();
    const Vec3 stretched(r0.dot(fibre), r1.dot(fibre), r2.dot(fibre));
    const double length = std::max(stretched.norm(), kShortestStretch);
    points.stretch[at(p)] = length;
    points.fibre[at(p)] = stretched / length;
  }
}

MYOTACT_VECTOR_CLONES
TetVector elastic_forces(const ElementInputs& in) {
  TetVector forces{};
  for (int p = 0; p < kTetPoints; ++p) {
    const double shear = in.material.shear_term_Pa() * (1.0 - 1.0 / (in.points.F_squared[at(p)] + 1.0));
    const double pressure = volume_stress(in.material, in.points, at(p));
    std::array<double, 9> P{};  // nominal stress
    for (int i = 0; i < 3; ++i) {
      const double pull = in.stress.stress_Pa[at(p)] * in.points.fibre[at(p)][i];
      for (int A = 0; A < 3; ++A) {
        const std::size_t k = at(3 * i + A);
        P[k] = shear * in.points.F[at(p)][k] + pressure * in.points.cofactor[at(p)][k] + pull * in.fibre[A];
      }
    }
    TetVector pushed;
    push_gradients(P, in.rest.gradients_1_m[at(p)], in.rest.point_volume_m3, pushed.data());
    for (std::size_t k = 0; k < pushed.size(); ++k) forces[k] += pushed[k];
  }
  return forces;
}

MYOTACT_VECTOR_CLONES
void elastic_stiffness(const ElementInputs& inputs, bool definite, TetMatrix& stiffness_N_m) {
  fill_slope_products(inputs, definite, stiffness_N_m);
  add_outer_products(rank_rows(inputs, definite), stiffness_N_m);
}

TetVector multiply(const TetMatrix& stiffness, const TetVector& vector) {
  TetVector product{};
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < kTetNodes; ++a) {
      const int r = i * kTetStride + a;
      for (int c = i * kTetStride; c < kTetDofs; ++c) {
        product[at(r)] += stiffness[at(r * kTetDofs + c)] * vector[at(c)];
      }
      for (int c = (i + 1) * kTetStride; c < kTetDofs; ++c) {
        product[at(c)] += stiffness[at(r * kTetDofs + c)] * vector[at(r)];
      }
    }
  }
  return product;
}

}  // namespace myotact::simulation
