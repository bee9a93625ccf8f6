#include "simulation/skin/skin_tissue.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "simulation/skin/skin_embedding.h"
#include "support/source_folder.h"

namespace myotact::simulation {
namespace {

/// A straight bar of two tets' boxes along x: fibres along x, the far half tendon.
anatomy::Muscle bar(const Vec3& fibre) {
  anatomy::Muscle muscle;
  muscle.tets.nodes_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {3, 0, 0}, {4, 0, 0}, {3, 1, 0}, {3, 0, 1}};
  muscle.tets.corners = {{0, 1, 2, 3}, {4, 5, 6, 7}};
  muscle.fibres = {fibre, fibre};
  muscle.regions = {anatomy::TissueRegion::Belly, anatomy::TissueRegion::Tendon};
  // The faces z = 0 and x = 0 of the first tet, the face y = 0 of the second.
  muscle.skin.positions_m = muscle.tets.nodes_m;
  muscle.skin.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 7}};
  return muscle;
}

Vec3 direction(const messages::TriangleTissue& tissue, const std::array<int, 3>& corners,
               const std::vector<Vec3>& positions_m) {
  const auto corner = [&](std::size_t c) -> const Vec3& { return positions_m[static_cast<std::size_t>(corners[c])]; };
  return tissue.fibre_edges[0] * (corner(1) - corner(0)) + tissue.fibre_edges[1] * (corner(2) - corner(0));
}

TEST(SkinTissue, FibresLieInTheTriangleAndRegionsAreThoseOfTheTets) {
  const Vec3 fibre = Vec3(1.0, 0.4, 0.0).normalized();
  const anatomy::Muscle muscle = bar(fibre);
  const auto tissue = skin_tissue(muscle, embed_skin(muscle.skin, muscle.tets));
  ASSERT_EQ(tissue.size(), 3u);
  EXPECT_EQ(tissue[0].tissue, messages::Tissue::Muscle);
  EXPECT_EQ(tissue[2].tissue, messages::Tissue::Tendon);
  const auto& positions_m = muscle.skin.positions_m;
  // In z = 0 the fibre itself; in x = 0 and y = 0 what of it lies in them. Stored in single precision.
  EXPECT_LT((direction(tissue[0], muscle.skin.triangles[0], positions_m) - fibre).norm(), 1e-6);
  EXPECT_LT((direction(tissue[1], muscle.skin.triangles[1], positions_m) - Vec3::UnitY()).norm(), 1e-6);
  EXPECT_LT((direction(tissue[2], muscle.skin.triangles[2], positions_m) - Vec3::UnitX()).norm(), 1e-6);
}

TEST(SkinTissue, FibresStretchAndTurnWithTheTriangle) {
  const anatomy::Muscle muscle = bar(Vec3(1.0, 0.4, 0.0).normalized());
  const auto tissue = skin_tissue(muscle, embed_skin(muscle.skin, muscle.tets));
  Mat3 A;
  A << 1.2, 0.3, 0.0, -0.5, 0.8, 0.1, 0.2, 0.0, 1.1;
  std::vector<Vec3> moved_m = muscle.skin.positions_m;
  for (Vec3& p : moved_m) p = A * p + Vec3(1, 2, 3);
  const Vec3 expected = A * Vec3(1.0, 0.4, 0.0).normalized();
  EXPECT_LT((direction(tissue[0], muscle.skin.triangles[0], moved_m) - expected).norm(), 1e-6);
}

TEST(SkinTissue, WhereFibresEndOrTheTriangleHasNoAreaThereIsNoDirection) {
  anatomy::Muscle muscle = bar(Vec3::UnitZ());
  muscle.skin.triangles[1] = {0, 1, 1};
  const auto tissue = skin_tissue(muscle, embed_skin(muscle.skin, muscle.tets));
  EXPECT_EQ(tissue[0].fibre_edges, (std::array<float, 2>{}));
  EXPECT_EQ(tissue[1].fibre_edges, (std::array<float, 2>{}));
}

TEST(SkinTissue, OnRealBicepsFibresRunFromOriginToInsertion) {
  const anatomy::Specimen specimen = anatomy::load_specimen(source_folder() + "/meshes/canine_elbow");
  const auto biceps = std::find_if(specimen.muscles.begin(), specimen.muscles.end(),
                                   [](const anatomy::Muscle& muscle) { return muscle.key == "biceps_brachii"; });
  ASSERT_NE(biceps, specimen.muscles.end());
  const auto line =
      std::find_if(specimen.lines.begin(), specimen.lines.end(), [&](const anatomy::MuscleLine& candidate) {
        return candidate.muscle == static_cast<int>(biceps - specimen.muscles.begin());
      });
  const Vec3 along = (line->points.back().position_m - line->points.front().position_m).normalized();
  const auto tissue = skin_tissue(*biceps, embed_skin(biceps->skin, biceps->tets));
  int fibrous = 0, aligned = 0;
  for (std::size_t t = 0; t < tissue.size(); ++t) {
    const Vec3 fibre = direction(tissue[t], biceps->skin.triangles[t], biceps->skin.positions_m);
    fibrous += fibre.norm() > 0.0 ? 1 : 0;
    aligned += fibre.dot(along) > 0.7 ? 1 : 0;  // within 45 degrees: biceps is a spindle, its ends are round
  }
  EXPECT_GT(fibrous, static_cast<int>(0.95 * static_cast<double>(tissue.size())));
  EXPECT_GT(aligned, static_cast<int>(0.9 * fibrous));
}

}  // namespace
}  // namespace myotact::simulation
