#include "simulation/element/muscle_batch.h"

#include "simulation/material/fibre_family.h"

namespace myotact::simulation {
namespace {

/// A deformed tet, or several, with what its terms are multiplied with.
template <class Real>
struct MuscleTets {
  TetShape<Real> shape;
  std::array<Point<Real>, 4> points;
  std::array<Real, 4> stress, slope, stretch;
  MeanVolume<Real> volume;
};

template <class Real>
MYOTACT_INLINE Real fibre_stretch(const Point<Real>& point) {
  return larger(square_root(point.I4), constant<Real>(kShortestStretch));
}

template <class Real>
MYOTACT_INLINE void read_batch(const MuscleBatch& batch, int part, MuscleTets<Real>& tets) {
  detail::load<Real>(batch.shapes, part, tets.shape);
  detail::load<Real>(batch.points, part, tets.points);
  detail::load<Real>(batch.stress_Pa, part, tets.stress);
  detail::load<Real>(batch.slope_Pa, part, tets.slope);
  detail::load<Real>(batch.fluctuation_Pa, part, tets.volume.fluctuation_Pa);
  const auto& p = tets.points;
  tets.volume.mean_J = 0.25 * ((p[0].J + p[1].J) + (p[2].J + p[3].J));
  tets.volume.term = batch.matrix.volume(tets.volume.mean_J);
  for (std::size_t k = 0; k < 4; ++k) tets.stretch[k] = fibre_stretch(p[k]);
}

template <class Real>
MYOTACT_INLINE Real pressure_at(const MuscleTets<Real>& tets, std::size_t p) {
  return tets.volume.term.slope_Pa + point_volume(tets.volume, tets.points[p].J, kMuscleFoldedJ).slope_Pa;
}

/// m (1 - 1 / (I1 + 1)): what the matrix's shear multiplies F with.
template <class Real>
MYOTACT_INLINE Real shear_at(const StableNeoHookean& matrix, const Point<Real>& point) {
  const double m = matrix.shear_term_Pa();
  return m - m / (point.I1 + 1.0);
}

template <class Real>
MYOTACT_INLINE void add_fibre_tangent(const Point<Real>& point, const Real& across, const Real& along,
                                      std::array<Real, kPacked>& C) {
  Matrix3<Real> direction;
  for (std::size_t k = 0; k < 9; ++k) direction[k] = point.f[k / 3] * point.fibre[k % 3];
  add_outer(direction, along, C);
  for (std::size_t A = 0; A < 3; ++A) {
    for (std::size_t B = A; B < 3; ++B) {
      const Real value = across * point.fibre[A] * point.fibre[B];
      for (std::size_t i = 0; i < 3; ++i) C[packed(3 * i + A, 3 * i + B)] += value;
    }
  }
}

template <class Real>
MYOTACT_INLINE void muscle_tangent(const StableNeoHookean& matrix, const MuscleTets<Real>& tets, std::size_t p,
                                   bool definite, std::array<Real, kPacked>& C) {
  const Point<Real>& point = tets.points[p];
  const Real pressure = pressure_at(tets, p);
  Real identity = shear_at(matrix, point);
  Real across = tets.stress[p] / tets.stretch[p];
  Real along = tets.slope[p];
  if (definite) {
    // The eigenvalues of d2J/dF2 lie within +-sqrt(4/3 F:F); this much of the identity outweighs them.
    const Real size = larger(pressure, -pressure);
    identity = larger(identity, size * square_root(4.0 / 3.0 * point.I1));
    across = larger(across, Real{});
    along = larger(along, Real{});
  }
  const Real inverse = 1.0 / (point.I1 + 1.0);
  C = {};
  add_unit(identity, C);
  add_outer<Real>(point.F, 2.0 * matrix.shear_term_Pa() * inverse * inverse, C);
  add_outer<Real>(point.cofactor, point_volume(tets.volume, point.J, kMuscleFoldedJ).curvature_Pa, C);
  add_volume_curvature(point.F, pressure, C);
  const Real shortest = constant<Real>(kShortestStretch * kShortestStretch);
  const Real free = where_less(point.I4, shortest, Real{}, along - across);
  add_fibre_tangent<Real>(point, across, free / (tets.stretch[p] * tets.stretch[p]), C);
}

template <class Real>
MYOTACT_INLINE void volume_slopes(const MuscleTets<Real>& tets, TetNodeVectors<Real, QuadraticTet>& slope) {
  std::array<Matrix3<Real>, 4> cofactor;
  for (std::size_t p = 0; p < 4; ++p) cofactor[p] = tets.points[p].cofactor;
  tet_forces<QuadraticTet>(tets.shape, cofactor, slope);
}

}  // namespace

void muscle_forces(const MuscleBatch& batch, TetNodeVectors<Eight, QuadraticTet>& force_N) {
  run_batch([&]<class Real>(std::type_identity<Real>, int part) __attribute__((always_inline)) {
    MuscleTets<Real> tets;
    read_batch(batch, part, tets);
    std::array<Matrix3<Real>, 4> P;
    for (std::size_t p = 0; p < 4; ++p) {
      const Point<Real>& point = tets.points[p];
      const Real shear = shear_at(batch.matrix, point), pressure = pressure_at(tets, p);
      const Real pull = tets.stress[p] / tets.stretch[p];
      for (std::size_t k = 0; k < 9; ++k) {
        P[p][k] = (shear * point.F[k] + pressure * point.cofactor[k]) + pull * point.f[k / 3] * point.fibre[k % 3];
      }
    }
    TetNodeVectors<Real, QuadraticTet> out;
    tet_forces<QuadraticTet>(tets.shape, P, out);
    detail::store<Real>(out, part, force_N);
  });
}

void muscle_stiffness(const MuscleBatch& batch, bool definite, TetBlocks<Eight, QuadraticTet>& blocks_N_m) {
  run_batch([&]<class Real>(std::type_identity<Real>, int part) __attribute__((always_inline)) {
    MuscleTets<Real> tets;
    read_batch(batch, part, tets);
    std::array<PackedTangent<Real>, 4> C;
    for (std::size_t p = 0; p < 4; ++p) muscle_tangent(batch.matrix, tets, p, definite, C[p]);
    TetBlocks<Real, QuadraticTet> out;
    quadratic_stiffness(tets.shape, C, out);
    TetNodeVectors<Real, QuadraticTet> slope;
    volume_slopes(tets, slope);
    const Real factor = (tets.volume.term.curvature_Pa - tets.volume.fluctuation_Pa) / tets.shape.volume_m3;
    add_outer_blocks<QuadraticTet>(slope, factor, out);
    detail::store<Real>(out, part, blocks_N_m);
  });
}

void fibre_stretch_slopes(const TetShapes& shapes, const PointBatch<QuadraticTet>& points,
                          TetNodeVectors<Eight, QuadraticTet>& slope_m2) {
  run_batch([&]<class Real>(std::type_identity<Real>, int part) __attribute__((always_inline)) {
    TetShape<Real> shape;
    std::array<Point<Real>, 4> point;
    detail::load<Real>(shapes, part, shape);
    detail::load<Real>(points, part, point);
    std::array<Matrix3<Real>, 4> direction;
    for (std::size_t p = 0; p < 4; ++p) {
      const Real inverse = 1.0 / fibre_stretch(point[p]);
      for (std::size_t k = 0; k < 9; ++k) direction[p][k] = inverse * point[p].f[k / 3] * point[p].fibre[k % 3];
    }
    TetNodeVectors<Real, QuadraticTet> out;
    tet_forces<QuadraticTet>(shape, direction, out);
    detail::store<Real>(out, part, slope_m2);
  });
}

}  // namespace myotact::simulation
