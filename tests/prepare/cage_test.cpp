#include "prepare/tets/cage.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "prepare/remesh/crossing_triangles.h"
#include "prepare/shapes.h"
#include "prepare/surface/surface_pieces.h"

namespace myotact::prepare {
namespace {

TEST(EdgeForTets, IsThatOfRegularTets) {
  const double edge_m = 0.01;
  const double regular_m3 = edge_m * edge_m * edge_m / (6.0 * std::sqrt(2.0));
  EXPECT_NEAR(edge_for_tets_m(150.0 * regular_m3, 150.0), edge_m, 1e-12);
}

void expect_good_cage(const geometry::TriangleMesh& fine, double tets) {
  const double volume_m3 = geometry::enclosed_volume_m3(fine);
  const Cage cage = make_cage("part", fine, tets);
  EXPECT_NEAR(geometry::enclosed_volume_m3(cage.surface), volume_m3, 0.01 * volume_m3);
  EXPECT_NEAR(cage.quality.volume_m3, geometry::enclosed_volume_m3(cage.surface), 1e-9 * volume_m3);
  EXPECT_EQ(geometry::bad_edge_count(cage.surface), 0);
  EXPECT_TRUE(crossing_triangles(cage.surface).empty());
  EXPECT_LE(cage.deviation_m, 0.5 * cage.edge_m);
  EXPECT_GT(cage.quality.tets, 0.7 * tets);
  EXPECT_LT(cage.quality.tets, 1.5 * tets);
  EXPECT_GT(cage.quality.smallest_dihedral_deg, 5.0);
  EXPECT_GT(cage.quality.first_percentile_dihedral_deg, 10.0);
  EXPECT_GT(cage.quality.mean_ratio, 0.7);
  for (std::size_t v = 0; v < cage.surface.positions_m.size(); ++v) {
    EXPECT_EQ(cage.surface.positions_m[v], cage.tets.nodes_m[v]);
  }
}

TEST(MakeCage, FillsARod) {
  expect_good_cage(testing::rod_surface({}), 150.0);
  expect_good_cage(testing::rod_surface({}), 600.0);
}

TEST(MakeCage, FillsASheetThinnerThanItsEdges) {
  // 80 x 60 x 4 mm: 210 regular tets would have edges of 9.2 mm.
  testing::SheetShape sheet;
  sheet.thickness_m = 4e-3;
  sheet.bulge_m = 0.015;
  expect_good_cage(testing::sheet_surface(sheet), 210.0);
}

TEST(MakeCage, MakesASurfaceAnewThatTetGenRefuses) {
  constexpr double kRadius_m = 0.02, kApart_m = 0.024;
  geometry::TriangleMesh surface = testing::sphere_surface(Vec3::Zero(), kRadius_m, 4);
  append(surface, testing::sphere_surface({kApart_m, 0.0, 0.0}, kRadius_m, 4));  // crosses the first
  const Cage cage = make_cage("two balls", surface, 210.0);
  const double height_m = kRadius_m - 0.5 * kApart_m;
  const double lens_m3 = 2.0 * std::numbers::pi * height_m * height_m * (kRadius_m - height_m / 3.0);
  const double union_m3 = 8.0 / 3.0 * std::numbers::pi * std::pow(kRadius_m, 3) - lens_m3;
  EXPECT_NEAR(cage.quality.volume_m3, union_m3, 0.02 * union_m3);
  EXPECT_EQ(geometry::bad_edge_count(cage.surface), 0);
  EXPECT_TRUE(crossing_triangles(cage.surface).empty());
  EXPECT_GT(cage.quality.smallest_dihedral_deg, 5.0);
  EXPECT_GT(cage.attempts, 6);  // the first route has six
}

}  // namespace
}  // namespace myotact::prepare
