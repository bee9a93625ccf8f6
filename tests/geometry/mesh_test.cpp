#include <numbers>

#include <gtest/gtest.h>

#include "geometry/mesh_examples.h"

namespace myotact::geometry {
namespace {

TEST(TriangleMesh, VolumeAndAreaOfARightAngledTetrahedron) {
  TriangleMesh mesh = corner_surface();
  EXPECT_NEAR(enclosed_volume_m3(mesh), 1.0 / 6.0, 1e-15);
  EXPECT_NEAR(surface_area_m2(mesh), 1.5 + std::numbers::sqrt3 / 2.0, 1e-15);
  for (Vec3& p : mesh.positions_m) p += Vec3(1e3, -2e3, 5e2);  // far from the origin
  EXPECT_NEAR(enclosed_volume_m3(mesh), 1.0 / 6.0, 1e-9);
  for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_NEAR(enclosed_volume_m3(mesh), -1.0 / 6.0, 1e-9);
}

TEST(TriangleMesh, EdgesWithoutTwoOpposedTrianglesAreCounted) {
  TriangleMesh mesh = corner_surface();
  EXPECT_EQ(bad_edge_count(mesh), 0);
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  EXPECT_EQ(bad_edge_count(mesh), 3);  // one triangle turned over
  mesh = corner_surface();
  mesh.triangles.pop_back();
  EXPECT_EQ(bad_edge_count(mesh), 3);  // one missing
  mesh = corner_surface();
  mesh.triangles.push_back(mesh.triangles.front());
  EXPECT_EQ(bad_edge_count(mesh), 3);  // one twice
}

TEST(TriangleMesh, NormalsPointOutward) {
  const auto normals = vertex_normals(corner_surface());
  EXPECT_LT((normals[0] + Vec3(1, 1, 1).normalized()).norm(), 1e-12);
  EXPECT_GT(normals[1].x(), 0.0);
}

TEST(TetMesh, VolumeIsSigned) {
  TetFile file = two_tets();
  EXPECT_NEAR(corner_volume_m3(file.mesh, 0), 1.0 / 18.0, 1e-15);
  std::swap(file.mesh.corners[0][0], file.mesh.corners[0][1]);
  EXPECT_NEAR(corner_volume_m3(file.mesh, 0), -1.0 / 18.0, 1e-15);
}

TEST(TetMesh, EveryEdgeGetsOneNodeInItsMiddle) {
  const TetMesh linear = two_tets().mesh;
  std::vector<std::array<int, 2>> edges;
  const TetMesh mesh = make_quadratic(linear, &edges);
  EXPECT_EQ(mesh.nodes_m.size(), 5u + 9u);  // two tets with a common face have nine edges
  ASSERT_EQ(edges.size(), 9u);
  EXPECT_EQ(mesh.corners, linear.corners);
  for (std::size_t t = 0; t < mesh.corners.size(); ++t) {
    for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
      const auto node = [&](int k) {
        return mesh.nodes_m[static_cast<std::size_t>(mesh.corners[t][static_cast<std::size_t>(k)])];
      };
      const Vec3 middle = 0.5 * (node(kTetEdges[e][0]) + node(kTetEdges[e][1]));
      EXPECT_EQ(mesh.nodes_m[static_cast<std::size_t>(mesh.midsides[t][e])], middle);
    }
  }
  EXPECT_DOUBLE_EQ(total_volume_m3(mesh), total_volume_m3(linear));
}

}  // namespace
}  // namespace myotact::geometry
