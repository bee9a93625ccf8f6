#include "simulation/solid/patches.h"

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/box_mesh.h"
#include "geometry/tet_topology.h"

namespace myotact::simulation {
namespace {

/// Tets of a patch hang together by their faces: one volume for what lies apart would couple what does not touch.
TEST(Patches, HangTogetherAreOfOneMaterialAndFewerThanNodes) {
  std::mt19937 random(93);
  for (int round = 0; round < 20; ++round) {
    const auto cells = [&] { return 1 + static_cast<int>(random() % 5); };
    geometry::TetMesh mesh = geometry::make_box_mesh(Vec3(0.4, 0.3, 0.5), {cells(), cells(), cells()});
    std::shuffle(mesh.corners.begin(), mesh.corners.end(), random);
    std::vector<int> material;
    for (const auto& tet : mesh.corners) {
      material.push_back(mesh.nodes_m[static_cast<std::size_t>(tet[0])].z() < 0.2 ? 0 : 1);
    }
    const std::vector<int> patch = find_patches(mesh, material);
    ASSERT_EQ(patch.size(), mesh.corners.size());
    EXPECT_EQ(find_patches(mesh, material), patch);
    std::set<int> numbers(patch.begin(), patch.end());
    if (round % 2 == 0 && mesh.corners.size() > 100) {
      EXPECT_LT(numbers.size(), mesh.nodes_m.size());
    }
    for (const int number : numbers) {
      ASSERT_GE(number, 0);
      geometry::TetMesh part;
      part.nodes_m = mesh.nodes_m;
      std::set<int> materials;
      for (std::size_t t = 0; t < patch.size(); ++t) {
        if (patch[t] != number) continue;
        part.corners.push_back(mesh.corners[t]);
        materials.insert(material[t]);
      }
      const std::vector<int> blocks = geometry::face_connected_blocks(part);
      EXPECT_EQ(*std::max_element(blocks.begin(), blocks.end()), 0) << "patch " << number << " of round " << round;
      EXPECT_EQ(materials.size(), 1u);
    }
  }
}

}  // namespace
}  // namespace myotact::simulation
