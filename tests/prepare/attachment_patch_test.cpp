#include "prepare/architecture/attachment_patch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "prepare/shapes.h"

namespace myotact::prepare {
namespace {

using ::testing::HasSubstr;

const testing::RodShape kRod;

PatchGuide guide_at(double x_m, double area_m2) {
  PatchGuide guide;
  guide.bones = testing::box_surface({x_m - 0.01, -0.02, -0.02}, {x_m, 0.02, 0.02});
  guide.point_m = {x_m, 0.0, 0.0};
  guide.area_m2 = area_m2;
  return guide;
}

TEST(GrowPatch, TakesAtLeastThreePercentAndEightTriangles) {
  const geometry::TriangleMesh rod = testing::rod_surface(kRod);
  const AttachmentPatch patch = grow_patch("rod", rod, guide_at(0.0, 0.0));
  EXPECT_GE(patch.area_m2, 0.03 * geometry::surface_area_m2(rod));
  EXPECT_GE(patch.triangles.size(), 8u);
  EXPECT_LT(patch.area_m2, 0.06 * geometry::surface_area_m2(rod));
  EXPECT_LT(patch.bone_distance_m, 1e-12);
}

TEST(GrowPatch, ReachesTheMeasuredAreaAroundTheEndNearestToBone) {
  const geometry::TriangleMesh rod = testing::rod_surface(kRod);
  const double wanted_m2 = testing::rod_section_m2(kRod);
  const AttachmentPatch patch = grow_patch("rod", rod, guide_at(0.0, wanted_m2));
  EXPECT_GE(patch.area_m2, wanted_m2);
  EXPECT_LT(patch.area_m2, 1.3 * wanted_m2);
  for (const int v : patch.vertices) EXPECT_LT(rod.positions_m[static_cast<std::size_t>(v)].x(), 0.02);
}

TEST(GrowPatch, LeavesThePatchOfTheOtherEndAlone) {
  const geometry::TriangleMesh rod = testing::rod_surface(kRod);
  const AttachmentPatch first = grow_patch("rod", rod, guide_at(0.0, 0.0));
  const AttachmentPatch second = grow_patch("rod", rod, guide_at(0.0, 0.0), first.triangles);
  for (const int v : second.vertices) EXPECT_THAT(first.vertices, ::testing::Not(::testing::Contains(v)));
}

TEST(GrowPatch, RefusesAMuscleThatHangsInTheAir) {
  try {
    grow_patch("rod", testing::rod_surface(kRod), guide_at(-0.06, 0.0));
    FAIL() << "was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::BadData);
    EXPECT_THAT(error.what(), HasSubstr("60.0 mm from its bone"));
  }
}

}  // namespace
}  // namespace myotact::prepare
