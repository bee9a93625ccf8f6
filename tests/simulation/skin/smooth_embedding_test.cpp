#include "simulation/skin/smooth_embedding.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/at.h"
#include "geometry/box_mesh.h"

namespace myotact::simulation {
namespace {

constexpr double kHeight_m = 20e-3, kSpacing_m = 4e-3;  // of the slab, and between its nodes

/// A slab of 40 mm.
geometry::TetMesh slab() {
  return geometry::make_quadratic(geometry::make_box_mesh({40e-3, 40e-3, kHeight_m}, {5, 5, 3}));
}

/// Points on its upper face, 1 mm apart along x, as close as the skins of the limbs have them.
geometry::TriangleMesh track() {
  geometry::TriangleMesh skin;
  for (int i = 0; i <= 20; ++i) skin.positions_m.emplace_back(10e-3 + 1e-3 * i, 20e-3, kHeight_m);
  skin.triangles = {{0, 1, 2}};
  return skin;
}

SkinEmbedding smooth(const geometry::TriangleMesh& skin, const geometry::TetMesh& tets) {
  SkinEmbedding embedding = embed_skin(skin, tets);
  smooth_embedding(skin, tets, embedding);
  return embedding;
}

std::vector<Vec3> moved(const SkinEmbedding& embedding, const std::vector<Vec3>& nodes_m) {
  std::vector<Vec3> positions_m(embedding.vertices.size());
  update_skin(embedding, nodes_m, positions_m);
  return positions_m;
}

/// Largest angle between two pieces of the track [rad].
double sharpest_fold_rad(const std::vector<Vec3>& track_m) {
  double sharpest_rad = 0.0;
  for (std::size_t i = 1; i + 1 < track_m.size(); ++i) {
    const Vec3 before = track_m[i] - track_m[i - 1], after = track_m[i + 1] - track_m[i];
    sharpest_rad = std::max(sharpest_rad, std::atan2(before.cross(after).norm(), before.dot(after)));
  }
  return sharpest_rad;
}

TEST(SmoothEmbedding, RestAndWhatAllNodesDoTogetherAreFollowedExactly) {
  const geometry::TetMesh mesh = slab();
  const geometry::TriangleMesh skin = track();
  const SkinEmbedding embedding = smooth(skin, mesh);
  const std::vector<Vec3> back = moved(embedding, mesh.nodes_m);
  for (std::size_t i = 0; i < back.size(); ++i) EXPECT_LT((back[i] - skin.positions_m[i]).norm(), 1e-15) << i;
  Mat3 A;
  A << 1.1, 0.2, 0.0, -0.1, 0.9, 0.3, 0.05, 0.0, 1.2;
  std::vector<Vec3> nodes_m = mesh.nodes_m;
  for (Vec3& node : nodes_m) node = A * node + Vec3(1, 2, 3);
  const std::vector<Vec3> now = moved(embedding, nodes_m);
  for (std::size_t i = 0; i < now.size(); ++i)
    EXPECT_LT((now[i] - A * skin.positions_m[i] - Vec3(1, 2, 3)).norm(), 1e-14) << i;
}

// Every vertex takes part of the nodes around it, and of no others.
TEST(SmoothEmbedding, NodesThatCountLieNearby) {
  const geometry::TetMesh mesh = slab();
  const geometry::TriangleMesh skin = track();
  const SkinEmbedding embedding = smooth(skin, mesh);
  for (std::size_t v = 0; v < embedding.vertices.size(); ++v) {
    const NodeWeights& vertex = embedding.vertices[v];
    ASSERT_EQ(vertex.count, 30);
    for (std::size_t i = 0; i < at(vertex.count); ++i) {
      EXPECT_LT((mesh.nodes_m[at(vertex.nodes[i])] - skin.positions_m[v]).norm(), 2.5 * kSpacing_m);
      EXPECT_LT(std::abs(vertex.weights[i]), 0.5);
    }
  }
}

// One node of the face pushed in by 3 mm: by the tets alone the dent has a fold, as a sphere would lie in.
TEST(SmoothEmbedding, ADentHasNoFold) {
  const geometry::TetMesh mesh = slab();
  std::vector<Vec3> nodes_m = mesh.nodes_m;
  const auto pushed = std::find_if(nodes_m.begin(), nodes_m.end(), [](const Vec3& node) {
    return (node - Vec3(20e-3, 20e-3, kHeight_m)).norm() < 1e-9;
  });
  ASSERT_NE(pushed, nodes_m.end());
  pushed->z() -= 3e-3;
  const double by_tets_rad = sharpest_fold_rad(moved(embed_skin(track(), mesh), nodes_m));
  const double smooth_rad = sharpest_fold_rad(moved(smooth(track(), mesh), nodes_m));
  EXPECT_GT(by_tets_rad, 1.0);
  EXPECT_LT(smooth_rad, 0.1);
}

// With nodes 5, 7 and 10 mm apart a force would spread over 12, 17 and 24 mm: smooth, partly so, and by the tets alone.
TEST(SmoothEmbedding, AForceIsNotSpreadWiderThanAFingertip) {
  const auto count = [](double spacing_m) {
    const double size_m = 12.0 * spacing_m;
    const geometry::TetMesh mesh =
        geometry::make_quadratic(geometry::make_box_mesh({size_m, size_m, size_m}, {6, 6, 6}));
    geometry::TriangleMesh skin;
    skin.positions_m = {{0.5 * size_m + 1e-3, 0.5 * size_m + 2e-3, size_m}};
    return smooth(skin, mesh).vertices[0].count;
  };
  EXPECT_EQ(count(5e-3), 30);
  EXPECT_GT(count(7e-3), 30);
  EXPECT_EQ(count(10e-3), 10);
}

TEST(SmoothEmbedding, SmallAndLinearMeshesAndPulledInVerticesStayAsTheyAre) {
  const geometry::TriangleMesh skin = track();
  const auto same = [&](const geometry::TriangleMesh& points, const geometry::TetMesh& mesh) {
    const SkinEmbedding before = embed_skin(points, mesh), after = smooth(points, mesh);
    for (std::size_t v = 0; v < before.vertices.size(); ++v) {
      EXPECT_EQ(before.vertices[v].nodes, after.vertices[v].nodes);
      EXPECT_EQ(before.vertices[v].weights, after.vertices[v].weights);
    }
  };
  same(skin, geometry::make_box_mesh({40e-3, 40e-3, kHeight_m}, {5, 5, 3}));
  same(skin, geometry::make_quadratic(geometry::make_box_mesh({40e-3, 40e-3, kHeight_m}, {1, 1, 1})));
  geometry::TriangleMesh far;
  far.positions_m = {{20e-3, 20e-3, 60e-3}};
  same(far, slab());
}

}  // namespace
}  // namespace myotact::simulation
