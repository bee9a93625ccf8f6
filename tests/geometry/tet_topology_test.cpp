#include "geometry/tet_topology.h"

#include <set>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "geometry/box_mesh.h"

namespace myotact::geometry {
namespace {

const Vec3& node(const TetMesh& mesh, int index) {
  return mesh.nodes_m[static_cast<std::size_t>(index)];
}

TEST(BoxMesh, FillsTheBoxWithSixEqualTetsACell) {
  const TetMesh mesh = make_box_mesh(Vec3(0.3, 0.2, 0.1), {3, 2, 2});
  EXPECT_EQ(mesh.nodes_m.size(), 36U);
  ASSERT_EQ(mesh.corners.size(), 72U);
  for (std::size_t t = 0; t < mesh.corners.size(); ++t) {
    EXPECT_NEAR(corner_volume_m3(mesh, t), 0.3 * 0.2 * 0.1 / 72, 1e-15);
  }
  // Six in a row have one cell's eight nodes.
  for (std::size_t cell = 0; cell < 12; ++cell) {
    std::set<int> nodes;
    for (std::size_t t = 6 * cell; t < 6 * cell + 6; ++t) nodes.insert(mesh.corners[t].begin(), mesh.corners[t].end());
    EXPECT_EQ(nodes.size(), 8U);
  }
}

TEST(BoxMesh, IsItsOwnMirrorImageWithAnEvenCount) {
  const TetMesh mesh = make_box_mesh(Vec3(1, 1, 1), {2, 2, 2});
  std::set<std::set<int>> tets;
  std::set<std::set<int>> mirrored;
  for (const auto& corners : mesh.corners) {
    std::set<int> image;
    for (const int n : corners) {
      const int j = n / 3 % 3;
      image.insert(n + 3 * (2 - 2 * j));
    }
    tets.insert({corners.begin(), corners.end()});
    mirrored.insert(image);
  }
  EXPECT_EQ(tets, mirrored);
}

TEST(TetTopology, TheBoundaryClosesOutward) {
  const TetMesh mesh = make_quadratic(make_box_mesh(Vec3(0.3, 0.2, 0.1), {3, 2, 1}));
  const auto triangles = boundary_triangles(mesh);
  EXPECT_EQ(triangles.size(), 2U * 2U * (3 * 2 + 3 * 1 + 2 * 1));  // a neighbour that does not fit would add faces
  double volume_m3 = 0.0;
  for (const BoundaryTriangle& triangle : triangles) {
    const Vec3& a = node(mesh, triangle.corners[0]);
    const Vec3& b = node(mesh, triangle.corners[1]);
    const Vec3& c = node(mesh, triangle.corners[2]);
    volume_m3 += a.dot(b.cross(c)) / 6.0;
    EXPECT_EQ(node(mesh, triangle.midsides[0]), 0.5 * (a + b));
    EXPECT_EQ(node(mesh, triangle.midsides[1]), 0.5 * (b + c));
    EXPECT_EQ(node(mesh, triangle.midsides[2]), 0.5 * (c + a));
  }
  EXPECT_NEAR(volume_m3, 0.3 * 0.2 * 0.1, 1e-15);
}

TEST(TetTopology, PartsAreTetsThatHangTogether) {
  TetMesh mesh;
  mesh.nodes_m.assign(11, Vec3::Zero());
  mesh.corners = {{0, 1, 2, 3}, {4, 5, 6, 7}, {3, 8, 9, 10}};
  EXPECT_EQ(connected_parts(mesh), (std::vector<int>{0, 1, 0}));
}

TEST(TetTopology, BlocksAreTetsThatShareFaces) {
  TetMesh mesh;
  mesh.nodes_m.assign(9, Vec3::Zero());
  mesh.corners = {{0, 1, 2, 3}, {1, 2, 4, 5}, {3, 0, 6, 1}, {6, 7, 8, 4}};
  EXPECT_EQ(face_connected_blocks(mesh), (std::vector<int>{0, 1, 0, 2}));
  const TetMesh box = make_box_mesh(Vec3(0.3, 0.2, 0.1), {3, 2, 1});
  EXPECT_EQ(face_connected_blocks(box), std::vector<int>(box.corners.size(), 0));
}

}  // namespace
}  // namespace myotact::geometry
