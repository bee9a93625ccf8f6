#include "prepare/architecture/fibre_field.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "prepare/architecture/sections.h"
#include "prepare/shapes.h"
#include "prepare/tets/tetrahedralise.h"

namespace myotact::prepare {
namespace {

const testing::RodShape kRod;

struct Rod {
  geometry::TriangleMesh surface = testing::rod_surface(kRod);
  geometry::TetMesh tets = tetrahedralise("rod", surface);
};

FibreField field_between_ends(const Rod& rod) {
  return solve_fibres("rod", rod.tets, rod.surface, {testing::rod_end(rod.surface, 0.0)},
                      {testing::rod_end(rod.surface, kRod.length_m)});
}

TEST(SolveFibres, RunsStraightThroughARodFromEndToEnd) {
  const Rod rod;
  const FibreField field = field_between_ends(rod);
  // The potential is linear, which linear tets hold exactly: only rounding is left.
  for (const Vec3& direction : field.direction) EXPECT_NEAR(direction.x(), 1.0, 1e-9);
  for (const Vec3& g : field.gradient) EXPECT_NEAR(g.norm() * testing::rod_section_m2(kRod), 1.0, 1e-9);
  EXPECT_EQ(field.filled_tets, 0);
}

TEST(SolveFibres, StaysWithinFiveDegreesOfTheAxisBetweenGrownPatches) {
  const Rod rod;
  PatchGuide begin, end;
  begin.bones = testing::box_surface({-0.01, -0.02, -0.02}, {0.0, 0.02, 0.02});
  end.bones = testing::box_surface({0.10, -0.02, -0.02}, {0.11, 0.02, 0.02});
  end.point_m = {0.10, 0.0, 0.0};
  const AttachmentPatch insertion = grow_patch("rod", rod.surface, end);
  const AttachmentPatch origin = grow_patch("rod", rod.surface, begin, insertion.triangles);
  const FibreField field = solve_fibres("rod", rod.tets, rod.surface, {origin}, {insertion});
  for (std::size_t t = 0; t < rod.tets.corners.size(); ++t) {
    double x_m = 0.0;
    for (const int n : rod.tets.corners[t]) x_m += 0.25 * rod.tets.nodes_m[static_cast<std::size_t>(n)].x();
    if (x_m < 0.25 * kRod.length_m || x_m > 0.75 * kRod.length_m) continue;
    EXPECT_GT(field.direction[t].x(), std::cos(5.0 * std::numbers::pi / 180.0));
  }
}

TEST(SliceMuscle, FindsSectionLengthAndMiddleOfARod) {
  const Rod rod;
  const MuscleProfile profile = slice_muscle(rod.tets, field_between_ends(rod));
  for (const double section_m2 : profile.section_m2) {
    EXPECT_NEAR(section_m2, testing::rod_section_m2(kRod), 0.01 * testing::rod_section_m2(kRod));
  }
  EXPECT_NEAR(profile.length_m, kRod.length_m, 0.01 * kRod.length_m);
  for (std::size_t s = 0; s < profile.centre_m.size(); ++s) {
    EXPECT_NEAR(profile.centre_m[s].x(), profile.arc_m[s], 0.04 * kRod.length_m);  // half a tet
    EXPECT_LT(profile.centre_m[s].tail<2>().norm(), 0.2 * kRod.radius_m);
  }
}

/// A sheet whose ends lie beside each other: no flux reaches most of it, and the middle slice says nothing.
TEST(SliceMuscle, TakesItsMeasureWhereTheFluxRuns) {
  const Rod rod;
  FibreField field = field_between_ends(rod);
  for (std::size_t t = 0; t < rod.tets.corners.size(); ++t) {
    double x_m = 0.0;
    for (const int n : rod.tets.corners[t]) x_m += 0.25 * rod.tets.nodes_m[static_cast<std::size_t>(n)].x();
    if (x_m > 0.3 * kRod.length_m) field.gradient[t] *= 1e-9;
  }
  for (const double section_m2 : slice_muscle(rod.tets, field).tet_section_m2) {
    EXPECT_GT(section_m2, 0.0);
    EXPECT_LE(section_m2, 3.1 * testing::rod_section_m2(kRod));
  }
}

TEST(SliceMuscle, GivesARodNoTendon) {
  const Rod rod;
  const MuscleProfile profile = slice_muscle(rod.tets, field_between_ends(rod));
  for (const anatomy::TissueRegion region : mark_regions(profile, find_belly(profile))) {
    EXPECT_EQ(region, anatomy::TissueRegion::Belly);
  }
}

MuscleProfile profile_of(std::vector<double> sections_m2, double step_m) {
  MuscleProfile profile;
  for (const double section_m2 : sections_m2) {
    profile.section_m2.push_back(section_m2);
    profile.arc_m.push_back(profile.length_m + 0.5 * step_m);
    profile.length_m += step_m;
  }
  return profile;
}

TEST(FindBelly, EndsWhereTheSectionFallsBelow45PercentOfTheLargest) {
  const BellySpan belly = find_belly(profile_of({0.2, 0.5, 1.0, 1.0, 1.0, 0.9, 0.44, 0.3}, 0.01));
  EXPECT_NEAR(belly.begin_m, 0.01, 1e-12);
  EXPECT_NEAR(belly.end_m, 0.06, 1e-12);
}

TEST(FindBelly, EndsWhereTheMuscleDividesIntoSlenderBranches) {
  MuscleProfile profile = profile_of({0.5, 1.0, 1.0, 1.0, 0.8, 0.9, 1.0, 0.9}, 0.04);
  profile.radius_m = {4e-3, 5e-3, 5e-3, 4e-3, 2e-3, 1e-3, 1e-3, 1e-3};  // 1 mm on 320 mm
  EXPECT_NEAR(find_belly(profile).end_m, 0.2, 1e-12);
  profile.radius_m.assign(8, 1e-3);  // a sheet is thin all over
  EXPECT_NEAR(find_belly(profile).end_m, 0.32, 1e-12);
}

TEST(FindBelly, KeepsHalfOfTheLength) {
  const BellySpan belly = find_belly(profile_of({0.1, 0.1, 0.1, 1.0, 1.0, 0.1, 0.1, 0.1, 0.1, 0.1}, 0.01));
  EXPECT_NEAR(belly.end_m - belly.begin_m, 0.05, 1e-12);
}

}  // namespace
}  // namespace myotact::prepare
