#pragma once

#include "simulation/element/tet_shape.h"

// How the stiffness of a pair of nodes is put together from the material's tangent in barycentric coordinates. With
// B^p_mn that tangent at point p for the coordinates m and n,
//
//   K_ab = sum over p, m, n of s_am(p) s_bn(p) B^p_mn.
//
// For a fixed (m, n) the factors of the four points differ at two of them at most, so the sum is shortened with
//
//   S = sum_p B^p      and      G^p = 4 n w B^p + 8 n^2 S,    n = kNear, w = 4 (kFar - kNear),
//
// in which most pairs of mid-side nodes are sums of G alone.

namespace myotact::simulation {

/// Place of coordinates m <= n in a list of their 10 pairs.
constexpr std::size_t coordinate_pair(std::size_t m, std::size_t n) {
  return m * 4 - m * (m + 1) / 2 + n;
}
/// How many there are.
inline constexpr std::size_t kCoordinatePairs = 10;
/// Blocks of one pair of coordinates: G of the four points, then S.
inline constexpr std::size_t kSumsPerPair = 5;

/// One block's part in the stiffness of a pair of nodes.
struct PairTerm {
  std::size_t block = 0;  // coordinate_pair * kSumsPerPair + (point or 4)
  double factor = 0.0;    // of that block
};

/// Terms of each pair of nodes: those with the blocks as they are, then those with the blocks transposed.
struct PairTerms {
  std::array<PairTerm, 800> terms{};  // list after list; not all are in use
  /// List 2 pair: as they are, list 2 pair + 1: transposed; each ends where the next one starts.
  std::array<std::size_t, 2 * kPairs<QuadraticTet> + 1> start{};
};

namespace detail {

inline constexpr double kBetween = 4.0 * (QuadraticTet::kFar - QuadraticTet::kNear);  // w
inline constexpr double kOfPoint = 4.0 * QuadraticTet::kNear * kBetween;              // of B^p in G^p
inline constexpr double kOfSum = 8.0 * QuadraticTet::kNear * QuadraticTet::kNear;     // of S in G^p

/// Factors of G^0 .. G^3 and S that give sum_p c_p B^p, with as many zeros as can be.
constexpr std::array<double, kSumsPerPair> factors_of_sums(const std::array<double, 4>& c) {
  double common = c[0];  // the value met most often
  int most = 0;
  for (double value : c) {
    int count = 0;
    for (double other : c) count += (value - other < 1e-12 && other - value < 1e-12) ? 1 : 0;
    if (count > most) {
      most = count;
      common = value;
    }
  }
  std::array<double, kSumsPerPair> factor{0.0, 0.0, 0.0, 0.0, common};
  for (std::size_t p = 0; p < 4; ++p) {
    factor[p] = (c[p] - common) / kOfPoint;
    factor[4] -= factor[p] * kOfSum;
  }
  return factor;
}

/// For all pairs of nodes a <= b, from the slopes of the shape functions.
constexpr PairTerms make_pair_terms() {
  PairTerms out;
  std::size_t next = 0, list = 0;
  for (std::size_t a = 0; a < QuadraticTet::kNodes; ++a) {
    for (std::size_t b = a; b < QuadraticTet::kNodes; ++b) {
      for (int transposed = 0; transposed < 2; ++transposed) {
        for (std::size_t m = 0; m < 4; ++m) {
          for (std::size_t n = m + static_cast<std::size_t>(transposed); n < 4; ++n) {
            std::array<double, 4> c{};
            for (std::size_t p = 0; p < 4; ++p) {
              c[p] = transposed != 0 ? shape_slope<QuadraticTet>(a, n, p) * shape_slope<QuadraticTet>(b, m, p)
                                     : shape_slope<QuadraticTet>(a, m, p) * shape_slope<QuadraticTet>(b, n, p);
            }
            const auto factor = factors_of_sums(c);
            for (std::size_t k = 0; k < kSumsPerPair; ++k) {
              if (factor[k] > -1e-12 && factor[k] < 1e-12) continue;
              out.terms[next++] = {coordinate_pair(m, n) * kSumsPerPair + k, factor[k]};
            }
          }
        }
        out.start[++list] = next;
      }
    }
  }
  return out;
}

}  // namespace detail

/// Made when compiling.
inline constexpr PairTerms kPairTerms = detail::make_pair_terms();

}  // namespace myotact::simulation
