#pragma once

#include <array>
#include <cstddef>

#include "geometry/tet_mesh.h"

// Shape functions of straight-sided tets in their four barycentric coordinates L0 .. L3. The coordinates' gradients are
// constant over an element and all that is left of its shape; slopes against the coordinates are the same for all
// elements.

namespace myotact::simulation {

/// Linear: N_a = L_a, one integration point.
struct LinearTet {
  static constexpr std::size_t kNodes = 4;
  static constexpr std::size_t kPoints = 1;
};

/// Quadratic: corners N_a = L_a (2 L_a - 1), mid-sides N = 4 L_i L_j; the 4-point rule of degree 2, whose point p has
/// the coordinate L_p = kFar and the others kNear.
struct QuadraticTet {
  static constexpr std::size_t kNodes = 10;
  static constexpr std::size_t kPoints = 4;
  static constexpr double kFar = 0.58541019662496845446;   // (5 + 3 sqrt 5) / 20
  static constexpr double kNear = 0.13819660112501051518;  // (5 - sqrt 5) / 20
};

/// Node between the corners m and q of a quadratic tet; the corner itself for m = q.
inline constexpr std::array<std::array<std::size_t, 4>, 4> kNodeBetween = [] {
  std::array<std::array<std::size_t, 4>, 4> node{};
  for (std::size_t m = 0; m < 4; ++m) node[m][m] = m;
  for (std::size_t e = 0; e < 6; ++e) {
    const auto i = static_cast<std::size_t>(geometry::kTetEdges[e][0]);
    const auto j = static_cast<std::size_t>(geometry::kTetEdges[e][1]);
    node[i][j] = node[j][i] = 4 + e;
  }
  return node;
}();

/// dN_node / dL_m at an integration point, the four coordinates taken as independent.
template <class Tet>
constexpr double shape_slope(std::size_t node, std::size_t m, std::size_t point) {
  if constexpr (Tet::kNodes == 4) {
    return node == m ? 1.0 : 0.0;
  } else {
    double slope = 0.0;
    for (std::size_t q = 0; q < 4; ++q) {
      if (kNodeBetween[m][q] == node) slope += 4.0 * (q == point ? Tet::kFar : Tet::kNear) - (q == m ? 1.0 : 0.0);
    }
    return slope;
  }
}

/// Pairs of nodes a <= b of an element, row by row.
template <class Tet>
inline constexpr std::size_t kPairs = Tet::kNodes*(Tet::kNodes + 1) / 2;

}  // namespace myotact::simulation
