#include "geometry/refine.h"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

namespace myotact::geometry {
namespace {

/// Two tets of different shape on one face.
TetMesh two_tets() {
  TetMesh mesh;
  mesh.nodes_m = {{0, 0, 0}, {1, 0.1, 0}, {0.2, 1, 0}, {0.3, 0.2, 0.9}, {0.9, 0.8, 1.1}};
  mesh.corners = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  for (std::size_t t = 0; t < 2; ++t) {
    if (corner_volume_m3(mesh, t) < 0.0) std::swap(mesh.corners[t][2], mesh.corners[t][3]);
  }
  return mesh;
}

TEST(Refine, CutsEveryTetIntoEightOfEqualVolume) {
  const TetMesh coarse = two_tets(), fine = refine(coarse);
  ASSERT_EQ(fine.corners.size(), 16U);
  for (std::size_t child = 0; child < fine.corners.size(); ++child) {
    const double parent_m3 = corner_volume_m3(coarse, child / 8);
    EXPECT_NEAR(corner_volume_m3(fine, child), parent_m3 / 8.0, 1e-14 * parent_m3);
  }
}

/// Every face belongs to two tets, or to one and then to the surface, where each of the 6 faces becomes four.
TEST(Refine, FitsAcrossTheSharedFace) {
  const TetMesh fine = refine(two_tets());
  std::map<std::array<int, 3>, int> uses;
  for (const auto& corners : fine.corners) {
    for (std::size_t opposite = 0; opposite < 4; ++opposite) {
      std::array<int, 3> face{};
      for (std::size_t k = 0, c = 0; c < 4; ++c) {
        if (c != opposite) face[k++] = corners[c];
      }
      std::sort(face.begin(), face.end());
      ++uses[face];
    }
  }
  int surface = 0;
  for (const auto& [face, count] : uses) {
    EXPECT_LE(count, 2);
    surface += count == 1 ? 1 : 0;
  }
  EXPECT_EQ(surface, 24);
}

TEST(Refine, NumbersAddedNodesAsTheQuadraticMeshDoes) {
  std::vector<std::array<int, 2>> edges;
  const TetMesh coarse = two_tets(), fine = refine(coarse, &edges);
  ASSERT_EQ(edges.size(), fine.nodes_m.size() - coarse.nodes_m.size());
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const Vec3 middle = 0.5 * (coarse.nodes_m[static_cast<std::size_t>(edges[k][0])] +
                               coarse.nodes_m[static_cast<std::size_t>(edges[k][1])]);
    EXPECT_LT((fine.nodes_m[coarse.nodes_m.size() + k] - middle).norm(), 1e-15);
  }
}

}  // namespace
}  // namespace myotact::geometry
