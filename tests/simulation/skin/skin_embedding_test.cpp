#include "simulation/skin/skin_embedding.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "core/error.h"

namespace myotact::simulation {
namespace {

/// Two tets on the unit corner, sharing the face x + y + z = 1.
geometry::TetMesh two_tets() {
  geometry::TetMesh mesh;
  mesh.nodes_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  mesh.corners = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  if (geometry::corner_volume_m3(mesh, 1) < 0.0) mesh.corners[1] = {2, 1, 3, 4};
  return mesh;
}

geometry::TriangleMesh skin_of(std::vector<Vec3> positions_m) {
  geometry::TriangleMesh skin;
  skin.positions_m = std::move(positions_m);
  skin.triangles = {{0, 1, 2}};
  return skin;
}

const std::vector<Vec3> kInside = {{0.1, 0.2, 0.3}, {0.5, 0.5, 0.5}, {0.25, 0.25, 0.0}, {1, 0, 0}};

std::vector<Vec3> moved(const SkinEmbedding& embedding, const std::vector<Vec3>& nodes_m) {
  std::vector<Vec3> positions_m(embedding.vertices.size());
  update_skin(embedding, nodes_m, positions_m);
  return positions_m;
}

TEST(SkinEmbedding, RestPositionsComeBackExactly) {
  for (const bool quadratic : {false, true}) {
    const geometry::TetMesh mesh = quadratic ? geometry::make_quadratic(two_tets()) : two_tets();
    std::vector<Vec3> positions_m = kInside;
    positions_m.push_back(Vec3(0.2, 0.2, -0.1));  // outside, within the overshoot
    const SkinEmbedding embedding = embed_skin(skin_of(positions_m), mesh);
    EXPECT_EQ(embedding.outside_count, 1);
    EXPECT_EQ(embedding.clamped_count, 0);
    EXPECT_NEAR(embedding.farthest_m, 0.1, 1e-15);
    const std::vector<Vec3> back = moved(embedding, mesh.nodes_m);
    for (std::size_t i = 0; i < back.size(); ++i) EXPECT_LT((back[i] - positions_m[i]).norm(), 1e-14) << i;
  }
}

TEST(SkinEmbedding, FollowsAQuadraticMotionInsideExactly) {
  const geometry::TetMesh mesh = geometry::make_quadratic(two_tets());
  const auto motion = [](const Vec3& x) -> Vec3 {
    return {x.x() + 0.3 * x.x() * x.y(), 2.0 * x.y() - x.z() * x.z(), x.z() + 0.1 * x.x() * x.x() + 0.5};
  };
  std::vector<Vec3> nodes_m = mesh.nodes_m;
  for (Vec3& node : nodes_m) node = motion(node);
  const std::vector<Vec3> now = moved(embed_skin(skin_of(kInside), mesh), nodes_m);
  for (std::size_t i = 0; i < now.size(); ++i) EXPECT_LT((now[i] - motion(kInside[i])).norm(), 1e-14) << i;
}

TEST(SkinEmbedding, OutsideFollowsAnAffineMotionExactly) {
  const geometry::TetMesh mesh = geometry::make_quadratic(two_tets());
  Mat3 A;
  A << 1.1, 0.2, 0.0, -0.1, 0.9, 0.3, 0.05, 0.0, 1.2;
  std::vector<Vec3> nodes_m = mesh.nodes_m;
  for (Vec3& node : nodes_m) node = A * node + Vec3(1, 2, 3);
  const Vec3 p(0.3, 0.2, -0.15);
  const std::vector<Vec3> now = moved(embed_skin(skin_of({p}), mesh), nodes_m);
  EXPECT_LT((now[0] - (A * p + Vec3(1, 2, 3))).norm(), 1e-14);
}

TEST(SkinEmbedding, FarVerticesArePulledInAndCounted) {
  const geometry::TetMesh mesh = geometry::make_quadratic(two_tets());
  const SkinEmbedding embedding = embed_skin(skin_of({{0.2, 0.2, -3.0}}), mesh);
  EXPECT_EQ(embedding.outside_count, 1);
  EXPECT_EQ(embedding.clamped_count, 1);
  EXPECT_NEAR(embedding.farthest_m, 3.0, 1e-14);
  // The coordinate of the corner (0,0,1) is z: it stops at minus the overshoot.
  EXPECT_LT((moved(embedding, mesh.nodes_m)[0] - Vec3(0.2, 0.2, -kLargestOvershoot)).norm(), 1e-14);
}

TEST(SkinEmbedding, AMaterialPointIsThePointOfItsTriangle) {
  const geometry::TetMesh mesh = geometry::make_quadratic(two_tets());
  const SkinEmbedding embedding = embed_skin(skin_of(kInside), mesh);
  std::vector<Vec3> nodes_m = mesh.nodes_m;
  for (std::size_t i = 0; i < nodes_m.size(); ++i)
    nodes_m[i] += Vec3(std::sin(double(i)), std::cos(double(i)), 0.1) * 0.1;
  const std::vector<Vec3> skin_m = moved(embedding, nodes_m);
  const MaterialPoint point = material_point(embedding, {0, 1, 2}, {0.2, 0.5, 0.3});
  Vec3 sum = Vec3::Zero();
  double weight = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(point.count); ++i) {
    sum += point.weights[i] * nodes_m[static_cast<std::size_t>(point.nodes[i])];
    weight += point.weights[i];
    for (std::size_t k = 0; k < i; ++k) EXPECT_NE(point.nodes[i], point.nodes[k]);
  }
  EXPECT_LT((sum - (0.2 * skin_m[0] + 0.5 * skin_m[1] + 0.3 * skin_m[2])).norm(), 1e-14);
  EXPECT_NEAR(weight, 1.0, 1e-14);
}

TEST(SkinEmbedding, AFlatTetIsPassedOverAndNoTetIsRefused) {
  geometry::TetMesh mesh = two_tets();
  mesh.corners.push_back({0, 1, 2, 0});
  const SkinEmbedding embedding = embed_skin(skin_of({{0.2, 0.2, -0.1}}), mesh);
  EXPECT_LT((moved(embedding, mesh.nodes_m)[0] - Vec3(0.2, 0.2, -0.1)).norm(), 1e-14);
  EXPECT_THROW(embed_skin(skin_of(kInside), geometry::TetMesh{}), Error);
}

}  // namespace
}  // namespace myotact::simulation
