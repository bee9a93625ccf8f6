#include "simulation/muscle/spring_net.h"

#include <algorithm>
#include <cmath>

#include "geometry/tet_mesh.h"
#include "simulation/material/fibre_family.h"

namespace myotact::simulation {
namespace {

using Nodes = TetNodeVectors<Eight, LinearTet>;
using Blocks = TetBlocks<Eight, LinearTet>;

/// Shortest length of an edge in the arithmetic, so that two nodes in one place do not divide by zero [m].
constexpr double kShortestEdge_m = 1e-9;

/// Place of a pair of nodes a <= b.
constexpr std::size_t pair_of(std::size_t a, std::size_t b) {
  return a * LinearTet::kNodes - a * (a + 1) / 2 + b;
}

/// A tet, or several, with what all its terms share.
template <class Real>
struct Tets {
  TetShape<Real> shape;
  Point<Real> point;
  Real stress, slope, stretch;
  std::array<Vector3<Real>, LinearTet::kNodes> volume_slope;  // dJ/dx of each node [1/m]
  std::array<Real, LinearTet::kNodes> along;                  // slope of the node's shape function along the fibre
};

template <class Real>
MYOTACT_INLINE Tets<Real> read_tets(const SpringTets& batch, int part) {
  Tets<Real> tets;
  detail::load<Real>(batch.batch.tets.shapes, part, tets.shape);
  detail::load<Real>(batch.point, part, tets.point);
  detail::load<Real>(batch.stress_Pa, part, tets.stress);
  detail::load<Real>(batch.slope_Pa, part, tets.slope);
  tets.stretch = larger(square_root(tets.point.I4), constant<Real>(kShortestStretch));
  const Matrix3<Real>& cofactor = tets.point.cofactor;
  for (std::size_t a = 0; a < LinearTet::kNodes; ++a) {
    const Vector3<Real>& g = tets.shape.gradient_1_m[a];
    for (std::size_t i = 0; i < 3; ++i) {
      tets.volume_slope[a][i] = cofactor[3 * i] * g[0] + cofactor[3 * i + 1] * g[1] + cofactor[3 * i + 2] * g[2];
    }
    tets.along[a] = tets.shape.fibre[0] * g[0] + tets.shape.fibre[1] * g[1] + tets.shape.fibre[2] * g[2];
  }
  return tets;
}

/// An edge from its first node to its second.
template <class Real>
struct Edge {
  Vector3<Real> way_m;
  Real length_m, rest_m, stiffness_N_m;
};

template <class Real>
MYOTACT_INLINE Edge<Real> read_edge(const SpringTets& batch, std::size_t e, int part) {
  const auto [a, b] = edge_nodes(e);
  Edge<Real> edge;
  Vector3<Real> from, to;
  detail::load<Real>(batch.position_m[a], part, from);
  detail::load<Real>(batch.position_m[b], part, to);
  detail::load<Real>(batch.batch.edges.length_m[e], part, edge.rest_m);
  detail::load<Real>(batch.batch.edges.stiffness_N_m[e], part, edge.stiffness_N_m);
  for (std::size_t i = 0; i < 3; ++i) edge.way_m[i] = to[i] - from[i];
  const Vector3<Real>& d = edge.way_m;
  edge.length_m = larger(square_root(Real(d[0] * d[0] + d[1] * d[1] + d[2] * d[2])), constant<Real>(kShortestEdge_m));
  return edge;
}

/// Volume springs and fibres: V (kappa (J - 1) dJ/dx + stress dstretch/dx).
template <class Real>
MYOTACT_INLINE void set_tet_forces(const Tets<Real>& tets, TetNodeVectors<Real, LinearTet>& force) {
  const Real pressure = tets.shape.volume_m3 * kVolumeSpring_Pa * (tets.point.J - 1.0);
  const Real pull = tets.shape.volume_m3 * tets.stress / tets.stretch;
  for (std::size_t a = 0; a < LinearTet::kNodes; ++a) {
    for (std::size_t i = 0; i < 3; ++i) {
      force[a][i] = pressure * tets.volume_slope[a][i] + pull * tets.along[a] * tets.point.f[i];
    }
  }
}

template <class Real>
MYOTACT_INLINE void add_edge_force(const Edge<Real>& edge, std::size_t e, TetNodeVectors<Real, LinearTet>& force) {
  const auto [a, b] = edge_nodes(e);
  const Real pull = edge.stiffness_N_m * (1.0 - edge.rest_m / edge.length_m);
  for (std::size_t i = 0; i < 3; ++i) {
    force[a][i] -= pull * edge.way_m[i];
    force[b][i] += pull * edge.way_m[i];
  }
}

/// d2J/dx_a dx_b = eps_ijk w_k with w = F (g_a x g_b).
template <class Real>
MYOTACT_INLINE Vector3<Real> volume_twist(const Tets<Real>& tets, std::size_t a, std::size_t b) {
  const Vector3<Real> g = cross(tets.shape.gradient_1_m[a].data(), tets.shape.gradient_1_m[b].data());
  const Matrix3<Real>& F = tets.point.F;
  Vector3<Real> w;
  for (std::size_t i = 0; i < 3; ++i) w[i] = F[3 * i] * g[0] + F[3 * i + 1] * g[1] + F[3 * i + 2] * g[2];
  return w;
}

/// What the blocks of all pairs of a tet are multiplied with: volume springs, their twist, and the fibres' stress on
/// either side of the fibre and beyond that along it [N m].
template <class Real>
struct TetFactors {
  Real volume, twist, across, along;
};

template <class Real>
MYOTACT_INLINE TetFactors<Real> factors_of(const Tets<Real>& tets, bool definite) {
  const Real& volume = tets.shape.volume_m3;
  Real twist = volume * kVolumeSpring_Pa * (tets.point.J - 1.0);
  Real across = tets.stress / tets.stretch, slope = tets.slope;
  if (definite) {
    twist = Real{};
    across = larger(across, Real{});
    slope = larger(slope, Real{});
  }
  const Real shortest = constant<Real>(kShortestStretch * kShortestStretch);
  const Real free = where_less(tets.point.I4, shortest, Real{}, slope - across) / (tets.stretch * tets.stretch);
  return {volume * kVolumeSpring_Pa, twist, volume * across, volume * free};
}

template <class Real>
MYOTACT_INLINE Matrix3<Real> tet_block(const Tets<Real>& tets, const TetFactors<Real>& factors, std::size_t a,
                                       std::size_t b) {
  const Vector3<Real>&u = tets.volume_slope[a], &v = tets.volume_slope[b], &f = tets.point.f;
  const Vector3<Real> w = volume_twist(tets, a, b);
  const Real fibres = tets.along[a] * tets.along[b];
  Matrix3<Real> block;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    for (std::size_t c = 0; c < 3; ++c) {
      block[3 * i + c] = factors.volume * u[i] * v[c] + fibres * factors.along * f[i] * f[c];
    }
    block[3 * i + i] += fibres * factors.across;
    block[3 * i + j] += factors.twist * w[k];
    block[3 * i + k] -= factors.twist * w[j];
  }
  return block;
}

template <class Real>
MYOTACT_INLINE void set_tet_blocks(const Tets<Real>& tets, bool definite, TetBlocks<Real, LinearTet>& blocks) {
  const TetFactors<Real> factors = factors_of(tets, definite);
  for (std::size_t a = 0; a < LinearTet::kNodes; ++a) {
    for (std::size_t b = a; b < LinearTet::kNodes; ++b) blocks[pair_of(a, b)] = tet_block(tets, factors, a, b);
  }
}

/// k (n n^T + (1 - L / l) (1 - n n^T)), n the edge's direction.
template <class Real>
MYOTACT_INLINE void add_edge_blocks(const Edge<Real>& edge, std::size_t e, bool definite,
                                    TetBlocks<Real, LinearTet>& blocks) {
  const auto [a, b] = edge_nodes(e);
  Real transverse = 1.0 - edge.rest_m / edge.length_m;
  if (definite) transverse = larger(transverse, Real{});
  const Real inverse = 1.0 / edge.length_m;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      Real value = (1.0 - transverse) * (inverse * edge.way_m[i]) * (inverse * edge.way_m[j]);
      if (i == j) value += transverse;
      value *= edge.stiffness_N_m;
      blocks[pair_of(a, a)][3 * i + j] += value;
      blocks[pair_of(b, b)][3 * i + j] += value;
      blocks[pair_of(a < b ? a : b, a < b ? b : a)][3 * i + j] -= value;
    }
  }
}

}  // namespace

void spring_forces(const SpringTets& tets, Nodes& force_N) {
  run_batch([&]<class Real>(std::type_identity<Real>, int part) __attribute__((always_inline)) {
    TetNodeVectors<Real, LinearTet> out;
    set_tet_forces(read_tets<Real>(tets, part), out);
    for (std::size_t e = 0; e < kTetEdgeCount; ++e) add_edge_force(read_edge<Real>(tets, e, part), e, out);
    detail::store<Real>(out, part, force_N);
  });
}

void spring_stiffness(const SpringTets& tets, bool definite, Blocks& blocks_N_m) {
  run_batch([&]<class Real>(std::type_identity<Real>, int part) __attribute__((always_inline)) {
    TetBlocks<Real, LinearTet> out;
    set_tet_blocks(read_tets<Real>(tets, part), definite, out);
    for (std::size_t e = 0; e < kTetEdgeCount; ++e) add_edge_blocks(read_edge<Real>(tets, e, part), e, definite, out);
    detail::store<Real>(out, part, blocks_N_m);
  });
}

void spring_stretch_slopes(const SpringTets& tets, Nodes& slope_m2) {
  run_batch([&]<class Real>(std::type_identity<Real>, int part) __attribute__((always_inline)) {
    const Tets<Real> read = read_tets<Real>(tets, part);
    TetNodeVectors<Real, LinearTet> out;
    for (std::size_t a = 0; a < LinearTet::kNodes; ++a) {
      for (std::size_t i = 0; i < 3; ++i) {
        out[a][i] = read.shape.volume_m3 * read.along[a] * read.point.f[i] / read.stretch;
      }
    }
    detail::store<Real>(out, part, slope_m2);
  });
}

}  // namespace myotact::simulation
