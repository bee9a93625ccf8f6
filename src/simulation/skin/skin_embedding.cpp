#include "simulation/skin/skin_embedding.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "core/at.h"
#include "core/error.h"
#include "geometry/closest_point.h"

namespace myotact::simulation {
namespace {

using Barycentric = std::array<double, 4>;

/// Maps a point to the barycentric coordinates 1 .. 3 of a straight-sided tet.
struct TetFrame {
  Vec3 origin_m;
  Mat3 inverse;

  Barycentric barycentric(const Vec3& p) const {
    const Vec3 b = inverse * (p - origin_m);
    return {1.0 - b.sum(), b[0], b[1], b[2]};
  }
};

double lowest(const Barycentric& b) {
  return *std::min_element(b.begin(), b.end());
}

TetFrame make_frame(const geometry::TetMesh& tets, std::size_t tet) {
  const auto& corner = tets.corners[tet];
  const Vec3& origin = tets.nodes_m[at(corner[0])];
  Mat3 edges;
  for (int i = 0; i < 3; ++i) edges.col(i) = tets.nodes_m[at(corner[at(i + 1)])] - origin;
  const Mat3 inverse = edges.inverse();
  if (inverse.allFinite()) return {origin, inverse};
  // A flat tet: everything is far outside it.
  return {origin, Mat3::Constant(std::numeric_limits<double>::quiet_NaN())};
}

geometry::TrianglePoint closest_on_tet(const geometry::TetMesh& tets, std::size_t tet, const Vec3& p) {
  constexpr std::array<std::array<std::size_t, 3>, 4> kFaces = {{{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};
  geometry::TrianglePoint best;
  double best_m2 = std::numeric_limits<double>::infinity();
  const auto& corner = tets.corners[tet];
  for (const auto& [a, b, c] : kFaces) {
    const auto point = geometry::closest_point_on_triangle(p, tets.nodes_m[at(corner[a])], tets.nodes_m[at(corner[b])],
                                                           tets.nodes_m[at(corner[c])]);
    const double distance_m2 = (point.position_m - p).squaredNorm();
    if (distance_m2 < best_m2) {
      best_m2 = distance_m2;
      best = point;
    }
  }
  return best;
}

/// Weights at `inside`, carried on along the tangent to `wanted`.
NodeWeights tangent_weights(const geometry::TetMesh& tets, int tet, const Barycentric& inside,
                            const Barycentric& wanted) {
  NodeWeights result = shape_weights(tets, tet, inside);
  Barycentric change;
  for (std::size_t i = 0; i < 4; ++i) change[i] = wanted[i] - inside[i];
  if (!tets.quadratic()) {
    for (std::size_t i = 0; i < 4; ++i) result.weights[i] += change[i];
    return result;
  }
  for (std::size_t i = 0; i < 4; ++i) result.weights[i] += (4.0 * inside[i] - 1.0) * change[i];
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [a, b] = geometry::kTetEdges[e];
    result.weights[4 + e] += 4.0 * (inside[at(a)] * change[at(b)] + inside[at(b)] * change[at(a)]);
  }
  return result;
}

/// Finds tets for points; remembers the frames.
class TetFinder {
 public:
  explicit TetFinder(const geometry::TetMesh& tets) : tets_(tets) {
    for (std::size_t t = 0; t < tets.corners.size(); ++t) frames_.push_back(make_frame(tets, t));
  }

  /// Tet whose lowest barycentric coordinate of p is largest, if p is inside (or on) it, else -1.
  int containing(const Vec3& p) const {
    constexpr double kOnFace = -1e-9;  // rounding of a vertex that lies on a face
    int best = -1;
    double best_lowest = kOnFace;
    for (std::size_t t = 0; t < frames_.size(); ++t) {
      const double here = lowest(frames_[t].barycentric(p));
      if (here > best_lowest) {
        best_lowest = here;
        best = static_cast<int>(t);
      }
    }
    return best;
  }

  int nearest(const Vec3& p) const {
    int best = 0;
    double best_m2 = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < frames_.size(); ++t) {
      if (!frames_[t].inverse.allFinite()) continue;
      const double distance_m2 = (closest_on_tet(tets_, t, p).position_m - p).squaredNorm();
      if (distance_m2 < best_m2) {
        best_m2 = distance_m2;
        best = static_cast<int>(t);
      }
    }
    return best;
  }

  const TetFrame& frame(int tet) const { return frames_[at(tet)]; }

 private:
  const geometry::TetMesh& tets_;
  std::vector<TetFrame> frames_;
};

NodeWeights embed_outside(const geometry::TetMesh& tets, const TetFinder& finder, const Vec3& p,
                          SkinEmbedding& embedding) {
  const int tet = finder.nearest(p);
  const Vec3 foot = closest_on_tet(tets, at(tet), p).position_m;
  const Barycentric inside = finder.frame(tet).barycentric(foot);
  Barycentric wanted = finder.frame(tet).barycentric(p);
  ++embedding.outside_count;
  embedding.farthest_m = std::max(embedding.farthest_m, (p - foot).norm());
  double keep = 1.0;  // of the way from the foot to p
  for (std::size_t i = 0; i < 4; ++i) {
    if (wanted[i] < -kLargestOvershoot)
      keep = std::min(keep, (kLargestOvershoot + inside[i]) / (inside[i] - wanted[i]));
  }
  if (keep < 1.0) ++embedding.clamped_count;
  for (std::size_t i = 0; i < 4; ++i) wanted[i] = inside[i] + keep * (wanted[i] - inside[i]);
  return tangent_weights(tets, tet, inside, wanted);
}

}  // namespace

NodeWeights shape_weights(const geometry::TetMesh& tets, int tet, const std::array<double, 4>& barycentric) {
  NodeWeights result;
  result.tet = tet;
  result.count = tets.quadratic() ? 10 : 4;
  for (std::size_t i = 0; i < 4; ++i) {
    const double b = barycentric[i];
    result.nodes[i] = tets.corners[at(tet)][i];
    result.weights[i] = tets.quadratic() ? b * (2.0 * b - 1.0) : b;
  }
  if (!tets.quadratic()) return result;
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [a, b] = geometry::kTetEdges[e];
    result.nodes[4 + e] = tets.midsides[at(tet)][e];
    result.weights[4 + e] = 4.0 * barycentric[at(a)] * barycentric[at(b)];
  }
  return result;
}

SkinEmbedding embed_skin(const geometry::TriangleMesh& skin, const geometry::TetMesh& tets) {
  if (tets.corners.empty()) {
    throw bad_data("specimen", "muscle mesh",
                   "has no tetrahedra, so its skin has nothing to follow; run myotact-prepare");
  }
  const TetFinder finder(tets);
  SkinEmbedding embedding;
  embedding.vertices.reserve(skin.positions_m.size());
  for (const Vec3& p : skin.positions_m) {
    const int tet = finder.containing(p);
    embedding.vertices.push_back(tet >= 0 ? shape_weights(tets, tet, finder.frame(tet).barycentric(p))
                                          : embed_outside(tets, finder, p, embedding));
  }
  return embedding;
}

void update_skin(const SkinEmbedding& embedding, std::span<const Vec3> nodes_m, std::span<Vec3> positions_m) noexcept {
  for (std::size_t v = 0; v < embedding.vertices.size(); ++v) {
    const NodeWeights& vertex = embedding.vertices[v];
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < at(vertex.count); ++i) sum += vertex.weights[i] * nodes_m[at(vertex.nodes[i])];
    positions_m[v] = sum;
  }
}

MaterialPoint material_point(const SkinEmbedding& embedding, const std::array<int, 3>& triangle,
                             const std::array<double, 3>& barycentric) noexcept {
  MaterialPoint point;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    add_weights(embedding.vertices[at(triangle[corner])], barycentric[corner], point);
  }
  return point;
}

}  // namespace myotact::simulation
