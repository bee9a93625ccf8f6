#include "prepare/remesh/decimate.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "prepare/remesh/crossing_triangles.h"
#include "prepare/remesh/surface_distance.h"
#include "prepare/remesh/triangle_crossing.h"
#include "prepare/shapes.h"

namespace myotact::prepare {
namespace {

TEST(TrianglesMeet, TellsCrossingTouchingAndApart) {
  const Corners flat{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  EXPECT_TRUE(triangles_meet(flat, {Vec3(0.2, 0.2, -1), Vec3(0.2, 0.2, 1), Vec3(2, 2, 0.5)}));
  EXPECT_TRUE(triangles_meet(flat, {Vec3(0.2, 0.2, 0), Vec3(0.2, 0.2, 1), Vec3(2, 2, 0.5)}));    // a corner on it
  EXPECT_TRUE(triangles_meet(flat, {Vec3(0.1, 0.1, 0), Vec3(0.2, 0.1, 0), Vec3(0.1, 0.2, 0)}));  // inside, one plane
  EXPECT_FALSE(triangles_meet(flat, {Vec3(0.2, 0.2, 1e-300), Vec3(0.2, 0.3, 1), Vec3(2, 2, 0.5)}));
  EXPECT_FALSE(triangles_meet(flat, {Vec3(2, 2, 0), Vec3(3, 2, 0), Vec3(2, 3, 0)}));
}

TEST(Decimate, KeepsASphereWithinTheTolerance) {
  const double radius_m = 0.02;
  const geometry::TriangleMesh sphere = testing::sphere_surface(Vec3::Zero(), radius_m, 5);  // 20480 triangles
  const DecimateSettings settings{5e-3, 2e-4};
  const geometry::TriangleMesh coarse = decimate(sphere, settings);
  EXPECT_LT(coarse.triangles.size(), 1200u);
  EXPECT_EQ(geometry::bad_edge_count(coarse), 0);
  EXPECT_TRUE(crossing_triangles(coarse).empty());
  EXPECT_LE(surface_distance(coarse, sphere).largest_m, 1.2 * settings.tolerance_m);
}

TEST(Decimate, LeavesABoxItsCornersAndVolume) {
  const geometry::TriangleMesh box = testing::box_surface({0, 0, 0}, {0.03, 0.02, 0.01});
  const geometry::TriangleMesh result = decimate(box, {4e-3, 1e-4});
  EXPECT_NEAR(geometry::enclosed_volume_m3(result), 6e-6, 6e-9);
  EXPECT_GT(result.triangles.size(), 12u);  // long triangles were split
}

TEST(Coarsen, KeepsTheVolumeOfASheetThinnerThanItsEdges) {
  testing::SheetShape shape;
  shape.bulge_m = 0.02;
  const geometry::TriangleMesh sheet = testing::sheet_surface(shape);
  const double edge_m = 4.0 * shape.thickness_m;
  const geometry::TriangleMesh coarse = coarsen(sheet, {edge_m, 0.42 * edge_m});
  EXPECT_LT(coarse.triangles.size(), sheet.triangles.size() / 4);
  EXPECT_EQ(geometry::bad_edge_count(coarse), 0);
  EXPECT_TRUE(crossing_triangles(coarse).empty());
  EXPECT_LE(surface_distance(coarse, sheet).largest_m, 0.5 * edge_m);
  EXPECT_NEAR(geometry::enclosed_volume_m3(coarse) / geometry::enclosed_volume_m3(sheet), 1.0, 0.01);
}

TEST(Coarsen, KeepsAThinRodsTips) {
  testing::RodShape shape;
  shape.radius_m = 1e-3;
  shape.rings = 60;
  const geometry::TriangleMesh rod = testing::rod_surface(shape);
  const geometry::TriangleMesh coarse = coarsen(rod, {6e-3, 0.42 * 6e-3});
  Eigen::AlignedBox3d box;
  for (const Vec3& p : coarse.positions_m) box.extend(p);
  EXPECT_GT(box.sizes().x(), shape.length_m - 2.0 * 2.6e-3);
  EXPECT_TRUE(crossing_triangles(coarse).empty());
}

}  // namespace
}  // namespace myotact::prepare
