#include "simulation/skin/skin_tissue.h"

#include <algorithm>
#include <array>

#include <Eigen/LU>

#include "core/at.h"

namespace myotact::simulation {
namespace {

/// Sine of the angle to the triangle below which fibres have no direction in it: they end there.
constexpr double kLeastShare = 0.1;

messages::Tissue feel_of(anatomy::TissueRegion region) {
  switch (region) {
    case anatomy::TissueRegion::Tendon:
      return messages::Tissue::Tendon;
    case anatomy::TissueRegion::Aponeurosis:
      return messages::Tissue::Fascia;
    case anatomy::TissueRegion::Belly:
      break;
  }
  return messages::Tissue::Muscle;
}

/// Of three, the one that occurs twice, else the first.
anatomy::TissueRegion most_frequent(const std::array<anatomy::TissueRegion, 3>& regions) {
  return regions[1] == regions[2] ? regions[1] : regions[0];
}

/// The part of the fibre in the plane of the triangle, of unit length, in its two edges from corner 0.
std::array<float, 2> in_edges(const Vec3& fibre, const Vec3& edge_1, const Vec3& edge_2) {
  Eigen::Matrix2d gram;
  gram << edge_1.squaredNorm(), edge_1.dot(edge_2), edge_1.dot(edge_2), edge_2.squaredNorm();
  const double scale = gram(0, 0) * gram(1, 1);
  if (!(gram.determinant() > 1e-12 * scale)) return {};  // no area, no plane
  const Eigen::Vector2d share = gram.inverse() * Eigen::Vector2d(edge_1.dot(fibre), edge_2.dot(fibre));
  const double length = (share[0] * edge_1 + share[1] * edge_2).norm();
  if (!(length > kLeastShare * fibre.norm())) return {};
  return {static_cast<float>(share[0] / length), static_cast<float>(share[1] / length)};
}

}  // namespace

std::vector<messages::TriangleTissue> skin_tissue(const anatomy::Muscle& muscle, const SkinEmbedding& embedding) {
  std::vector<messages::TriangleTissue> tissue;
  tissue.reserve(muscle.skin.triangles.size());
  for (const std::array<int, 3>& corners : muscle.skin.triangles) {
    std::array<anatomy::TissueRegion, 3> regions{};
    Vec3 fibre = Vec3::Zero();
    for (std::size_t c = 0; c < 3; ++c) {
      const int tet = embedding.vertices[at(corners[c])].tet;
      regions[c] = muscle.regions[at(tet)];
      fibre += muscle.fibres[at(tet)];
    }
    const Vec3& origin_m = muscle.skin.positions_m[at(corners[0])];
    const std::array<float, 2> edges = in_edges(fibre, muscle.skin.positions_m[at(corners[1])] - origin_m,
                                                muscle.skin.positions_m[at(corners[2])] - origin_m);
    tissue.push_back({feel_of(most_frequent(regions)), edges});
  }
  return tissue;
}

}  // namespace myotact::simulation
