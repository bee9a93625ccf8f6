#include "prepare/part/part_surfaces.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "prepare/field/signed_distance.h"
#include "prepare/part/film.h"
#include "prepare/part/overlap_measure.h"
#include "prepare/remesh/crossing_triangles.h"
#include "prepare/shapes.h"

namespace myotact::prepare {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;

constexpr double kRadius_m = 0.015;

NamedSurface ball(const std::string& key, double x_m, double radius_m) {
  return {key, testing::sphere_surface({x_m, 0.0, 0.0}, radius_m, 3)};
}

/// Of a sphere cut off by a plane at the given height below its top.
double cap_m3(double radius_m, double height_m) {
  return std::numbers::pi * height_m * height_m * (radius_m - height_m / 3.0);
}

void expect_whole(const geometry::TriangleMesh& surface) {
  EXPECT_EQ(geometry::bad_edge_count(surface), 0);
  EXPECT_TRUE(crossing_triangles(surface).empty());
}

TEST(PartSurfaces, CutsTwoEqualBallsAtThePlaneBetweenThem) {
  std::vector<NamedSurface> muscles{ball("a", 0.0, kRadius_m), ball("b", 0.02, kRadius_m)};
  const auto reports = part_surfaces(muscles, {});
  const double cap = cap_m3(kRadius_m, kRadius_m - 0.01);
  for (const PartReport& report : reports) {
    EXPECT_NEAR(report.volume_lost_m3, cap, 0.06 * cap);
    EXPECT_THAT(report.hosts, ElementsAre());
  }
  EXPECT_THAT(reports[0].gave_way, ElementsAre(Pair(::testing::DoubleNear(2.0 * cap, 0.1 * cap), "b")));
  for (const NamedSurface& muscle : muscles) expect_whole(muscle.surface);
  for (const Vec3& p : muscles[0].surface.positions_m) EXPECT_LT(p.x(), 0.01);
  for (const Vec3& p : muscles[1].surface.positions_m) EXPECT_GT(p.x(), 0.01);
}

TEST(PartSurfaces, GivesWayToBoneWholly) {
  std::vector<NamedSurface> muscles{ball("a", 0.0, kRadius_m)};
  const std::vector<NamedSurface> bones{{"bone", testing::box_surface({0.01, -0.05, -0.05}, {0.05, 0.05, 0.05})}};
  const auto reports = part_surfaces(muscles, bones);
  const double cap = cap_m3(kRadius_m, kRadius_m - 0.01);
  EXPECT_NEAR(reports[0].volume_lost_m3, cap, 0.06 * cap);
  for (const Vec3& p : muscles[0].surface.positions_m) EXPECT_LT(p.x(), 0.01 + 1e-4);
}

TEST(PartSurfaces, HollowsTheHostOfANestedMuscle) {
  std::vector<NamedSurface> muscles{ball("host", 0.0, kRadius_m), ball("nested", 0.013, 0.005)};
  const auto reports = part_surfaces(muscles, {});
  EXPECT_THAT(reports[1].hosts, ElementsAre("host"));
  EXPECT_EQ(reports[1].volume_lost_m3, 0.0);
  expect_whole(muscles[0].surface);
  const SignedDistance host(muscles[0].surface), nested(muscles[1].surface);
  EXPECT_EQ(measure_overlap(host, nested).depth_m, 0.0);
}

TEST(PartSurfaces, KeepsTheCoreOfATendonThatCrossesABelly) {
  testing::RodShape thin;
  thin.radius_m = 2e-3;
  thin.rings = 40;
  NamedSurface tendon{"tendon", testing::rod_surface(thin)};
  std::vector<NamedSurface> muscles{tendon, ball("belly", 0.05, kRadius_m)};
  part_surfaces(muscles, {});
  Eigen::AlignedBox3d box;
  for (const Vec3& p : muscles[0].surface.positions_m) box.extend(p);
  EXPECT_GT(box.sizes().x(), 0.99 * thin.length_m);  // in one piece from end to end
  expect_whole(muscles[0].surface);
}

TEST(PartSurfaces, LeadsAStrandOverBoneThatWouldCutAMuscleInTwo) {
  testing::RodShape thin;
  thin.radius_m = 3e-3;
  thin.rings = 40;
  std::vector<NamedSurface> muscles{{"tendon", testing::rod_surface(thin)}};
  const NamedSurface bone = ball("bone", 0.05, kRadius_m);
  const auto reports = part_surfaces(muscles, {bone});
  EXPECT_TRUE(reports[0].filmed);
  EXPECT_FALSE(reports[0].kept_core);
  EXPECT_LT(measure_overlap(SignedDistance(muscles[0].surface), SignedDistance(bone.surface)).depth_m, 5e-4);
  expect_whole(muscles[0].surface);
  Eigen::AlignedBox3d box;
  for (const Vec3& p : muscles[0].surface.positions_m) box.extend(p);
  EXPECT_GT(box.sizes().x(), 0.99 * thin.length_m);
  EXPECT_GT(reports[0].volume_lost_m3, 0.0);
}

/// 2 mm thick, in the plane z = 0.
NamedSurface thin_sheet() {
  return {"sheet", testing::sheet_surface({})};
}

TEST(PartSurfaces, CoversANestedMuscleThatStandsOutOfBothFacesOfASheet) {
  std::vector<NamedSurface> muscles{thin_sheet(), ball("ball", 0.0, 0.0012)};
  const auto reports = part_surfaces(muscles, {});
  EXPECT_THAT(reports[1].hosts, ElementsAre("sheet"));
  EXPECT_TRUE(reports[0].filmed);
  EXPECT_EQ(reports[0].added_genus, 0);
  EXPECT_EQ(genus(muscles[0].surface), 0);
  expect_whole(muscles[0].surface);
  EXPECT_LT(measure_overlap(SignedDistance(muscles[0].surface), SignedDistance(muscles[1].surface)).depth_m, 1e-4);
}

TEST(PartSurfaces, CoversBoneThatStandsOutOfASheet) {
  std::vector<NamedSurface> muscles{thin_sheet()};
  const std::vector<NamedSurface> bones{{"bone", testing::sphere_surface({0.0, 0.0, -0.006}, 0.008, 3)}};
  const auto reports = part_surfaces(muscles, bones);
  EXPECT_TRUE(reports[0].filmed);
  EXPECT_EQ(genus(muscles[0].surface), 0);
  expect_whole(muscles[0].surface);
  EXPECT_EQ(measure_overlap(SignedDistance(muscles[0].surface), SignedDistance(bones[0].surface)).depth_m, 0.0);
}

TEST(PartSurfaces, LeavesASheetBittenThatANeighbourReachesIntoFromItsEdge) {
  std::vector<NamedSurface> muscles{thin_sheet(), {"ball", testing::sphere_surface({0.0, 0.03, 0.0}, 0.012, 3)}};
  const auto reports = part_surfaces(muscles, {});
  EXPECT_GT(reports[0].volume_lost_m3, 0.0);
  EXPECT_FALSE(reports[0].filmed);
}

TEST(PartSurfaces, PassesMusclesThatTouchNothingBitForBit) {
  std::vector<NamedSurface> muscles{ball("a", 0.0, kRadius_m), ball("b", 0.04, kRadius_m)};
  const std::vector<NamedSurface> before = muscles;
  part_surfaces(muscles, {});
  for (std::size_t m = 0; m < muscles.size(); ++m) {
    EXPECT_EQ(muscles[m].surface.positions_m, before[m].surface.positions_m);
    EXPECT_EQ(muscles[m].surface.triangles, before[m].surface.triangles);
  }
}

TEST(PartSurfaces, NamesAMuscleThatLiesInBone) {
  std::vector<NamedSurface> muscles{ball("small", 0.0, 0.005)};
  try {
    part_surfaces(muscles, {ball("bone", 0.0, kRadius_m)});
    FAIL() << "was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::BadData);
    EXPECT_THAT(error.what(), ::testing::HasSubstr("small: part"));
  }
}

TEST(PartSurfaces, GivesTheSameBitsWithTwoThreads) {
  std::vector<NamedSurface> one{ball("a", 0.0, kRadius_m), ball("b", 0.02, kRadius_m)}, two = one;
  PartSettings settings;
  part_surfaces(one, {}, settings);
  settings.threads = 2;
  part_surfaces(two, {}, settings);
  for (std::size_t m = 0; m < one.size(); ++m) EXPECT_EQ(one[m].surface.positions_m, two[m].surface.positions_m);
}

}  // namespace
}  // namespace myotact::prepare
