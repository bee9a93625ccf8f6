#include "prepare/remesh/cage.h"

#include <cmath>

#include <gtest/gtest.h>

#include "prepare/remesh/surface_remesh.h"
#include "prepare/shapes.h"
#include "prepare/tets/tetrahedralise.h"

namespace myotact::prepare {
namespace {

TEST(EdgeForTets, IsThatOfRegularTets) {
  const double edge_m = 0.01;
  const double regular_m3 = edge_m * edge_m * edge_m / (6.0 * std::sqrt(2.0));
  EXPECT_NEAR(edge_for_tets_m(150.0 * regular_m3, 150.0), edge_m, 1e-12);
}

TEST(EvenSurface, KeepsTheVolumeAndDoesNotCross) {
  const geometry::TriangleMesh rod = testing::rod_surface({});
  const double volume_m3 = geometry::enclosed_volume_m3(rod);
  const EvenSurface cage = even_surface("rod", rod, edge_for_tets_m(volume_m3, 150.0));
  EXPECT_NEAR(geometry::enclosed_volume_m3(cage.mesh), volume_m3, 0.01 * volume_m3);
  EXPECT_EQ(geometry::bad_edge_count(cage.mesh), 0);
  EXPECT_TRUE(crossing_triangles(cage.mesh).empty());
}

TEST(EvenSurface, HasEdgesNearTheLengthAskedFor) {
  const EvenSurface skin = even_surface("rod", testing::rod_surface({}), 6e-3);
  int near = 0;
  for (const auto& [a, b, c] : skin.mesh.triangles) {
    const double edge_m =
        (skin.mesh.positions_m[static_cast<std::size_t>(a)] - skin.mesh.positions_m[static_cast<std::size_t>(b)])
            .norm();
    near += edge_m > 0.5 * skin.edge_m && edge_m < 1.6 * skin.edge_m ? 1 : 0;
  }
  EXPECT_GT(near, static_cast<int>(0.95 * static_cast<double>(skin.mesh.triangles.size())));
}

TEST(EvenSurface, MakesTheTetsAskedForAndNoFlatOnes) {
  const geometry::TriangleMesh rod = testing::rod_surface({});
  const EvenSurface cage = even_surface("rod", rod, edge_for_tets_m(geometry::enclosed_volume_m3(rod), 150.0));
  const TetQuality quality = measure_tets(tetrahedralise("rod", cage.mesh));
  EXPECT_GT(quality.tets, 90);
  EXPECT_LT(quality.tets, 230);
  EXPECT_GT(quality.smallest_dihedral_deg, 5.0);
}

}  // namespace
}  // namespace myotact::prepare
