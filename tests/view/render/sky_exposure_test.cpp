#include "view/render/sky_exposure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/data_folder.h"
#include "geometry/plain_surfaces.h"
#include "support/synthetic_specimen.h"
#include "view/look/limb_bounds.h"
#include "view/look/posing.h"
#include "view/look/start_view.h"
#include "view/overlay/seen_parts.h"
#include "view/render/depth_grid.h"
#include "view/view_frame.h"

namespace myotact::view {
namespace {

TEST(DepthGrid, KeepsTheNearestAtTheMiddlesOfItsCells) {
  DepthGrid grid(4, 3);
  grid.add({0, 0, 2}, {4, 0, 2}, {0, 4, 2}, 7);
  grid.add({0, 0, 0}, {2, 0, 2}, {0, 2, 0}, 8);  // depth = x
  EXPECT_EQ(grid.owner(0, 0), 8);
  EXPECT_NEAR(grid.depth(0, 0), 0.5f, 1e-6f);
  EXPECT_EQ(grid.owner(2, 0), 7);
  EXPECT_EQ(grid.owner(3, 2), DepthGrid::kNobody);
  EXPECT_TRUE(std::isinf(grid.depth(3, 2)));
  grid.add({-50, -50, 3}, {500, -50, 3}, {-50, 500, 3}, 9);  // far out of the grid on all sides, behind
  EXPECT_EQ(grid.owner(3, 2), 9);
  EXPECT_EQ(grid.owner(0, 0), 8);
  constexpr float kHuge = 1e30f, kNaN = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float wild : {kHuge, -kHuge, infinity, -infinity, kNaN})
    grid.add({wild, 0, 1}, {2, wild, 1}, {0, 1, 1}, 10);
  EXPECT_EQ(grid.owner(0, 0), 8);
}

ShadedSurface shaded(const geometry::TriangleMesh& surface) {
  ShadedSurface made{&surface, {}};
  for (const Vec3& n : geometry::vertex_normals(surface)) made.normals.push_back(to_glm(n));
  return made;
}

TEST(SkyExposure, AFreeBallSeesAllOfTheSky) {
  const geometry::TriangleMesh ball = geometry::make_ball(0.05, 4);
  const std::vector<ShadedSurface> scene{shaded(ball)};
  const auto exposure = sky_exposure(scene, {64, 200}).seen;
  for (const float seen : exposure[0]) EXPECT_GT(seen, 0.97f);
}

TEST(SkyExposure, BetweenTwoWideWallsTheFormFactorOfParallelDisksIsMissing) {
  // Light that a middle point of a wall loses to an equal disk of radius R at distance d: R^2 / (R^2 + d^2).
  constexpr double kSide_m = 0.2, kAway_m = 0.06;
  geometry::TriangleMesh lower = geometry::make_plane(kSide_m, 40), upper = lower;
  for (Vec3& p : upper.positions_m) p.z() += kAway_m;
  for (auto& triangle : upper.triangles) std::swap(triangle[1], triangle[2]);
  const std::vector<ShadedSurface> scene{shaded(lower), shaded(upper)};
  const auto exposure = sky_exposure(scene, {512, 300}).seen;
  std::size_t middle = 0;
  for (std::size_t i = 0; i < lower.positions_m.size(); ++i) {
    if (lower.positions_m[i].norm() < lower.positions_m[middle].norm()) middle = i;
  }
  // A square of this side lies between its inner and its outer circle.
  const auto missing = [&](double radius) { return radius * radius / (radius * radius + kAway_m * kAway_m); };
  EXPECT_GT(1.0 - double(exposure[0][middle]), missing(0.5 * kSide_m) - 0.03);
  EXPECT_LT(1.0 - double(exposure[0][middle]), missing(std::sqrt(0.5) * kSide_m) + 0.03);
}

TEST(SkyExposure, WhatIsFartherThanTheReachCastsNoShadeAndWhatIsNearerThanHalfOfItAllOfIt) {
  constexpr double kAway_m = 0.02;
  geometry::TriangleMesh lower = geometry::make_plane(0.2, 40), upper = lower;
  for (Vec3& p : upper.positions_m) p.z() += kAway_m;
  for (auto& triangle : upper.triangles) std::swap(triangle[1], triangle[2]);
  const std::vector<ShadedSurface> scene{shaded(lower), shaded(upper)};
  const auto middle =
      static_cast<std::size_t>(std::min_element(lower.positions_m.begin(), lower.positions_m.end(),
                                                [](const Vec3& a, const Vec3& b) { return a.norm() < b.norm(); }) -
                               lower.positions_m.begin());
  // Seen from the middle, the farthest of the other wall is 0.143 m away.
  const auto seen = [&](float reach_m) { return sky_exposure(scene, {64, 200, reach_m}).seen[0][middle]; };
  EXPECT_GT(seen(0.9f * float(kAway_m)), 0.99f);
  EXPECT_EQ(seen(2.1f * 0.143f), seen(std::numeric_limits<float>::infinity()));
  EXPECT_LT(seen(0.08f), 0.5f);
  const SkyExposure short_of = sky_exposure(scene, {64, 200, 0.9f * float(kAway_m)});
  EXPECT_EQ(short_of.outside[0][middle], seen(std::numeric_limits<float>::infinity()));
}

TEST(SkyExposure, InTheElbowTheDeepMusclesOfTheAnatomyBooksAreDeep) {
  // Evans and de Lahunta, Miller's Anatomy of the Dog, 4th ed., 6: anconeus and accessory head lie under the lateral
  // head of the triceps; long and lateral head lie under the skin.
  const auto specimen = anatomy::load_specimen(data_folder() / "meshes" / "canine_elbow");
  const LimbShade shade = shade_limb(specimen);
  const auto superficial = [&](const char* key) {
    return bool(shade.superficial[static_cast<std::size_t>(anatomy::find_muscle(specimen, key))]);
  };
  EXPECT_FALSE(superficial("anconeus"));
  EXPECT_FALSE(superficial("triceps_brachii_accessory"));
  EXPECT_TRUE(superficial("triceps_brachii_long"));
  EXPECT_TRUE(superficial("triceps_brachii_lateral"));
}

TEST(SeenParts, ANameIsAnchoredOnWhatIsSeenOfItsPart) {
  const auto specimen = myotact::testing::antagonist_hinge();
  const auto frame = myotact::testing::frame_at_rest(specimen);
  ViewState view = start_view(specimen, 1.5f);
  const SeenLimb limb = seen_parts(specimen, frame, view, {}, 1.5f);
  ASSERT_GE(limb.parts.size(), 4u);  // both muscles, both bones
  EXPECT_EQ(limb.parts[0].part, (Part{PartKind::Muscle, 0}));
  EXPECT_LT(limb.parts[0].place.y, limb.parts[1].place.y);  // the flexor above the extensor
  // The flexor's middle, projected: a bar is seen to its middle.
  const glm::vec4 clip = view.camera.clip_from_world(1.5f) * glm::vec4(-0.03f, 0.01f, 0.03f, 1.0f);
  EXPECT_NEAR(limb.parts[0].place.x, 0.5f + 0.5f * clip.x / clip.w, 0.02f);
  EXPECT_NEAR(limb.parts[0].place.y, 0.5f - 0.5f * clip.y / clip.w, 0.02f);
  view.muscles[0].hidden = true;
  EXPECT_EQ(seen_parts(specimen, frame, view, {}, 1.5f).parts[0].part, (Part{PartKind::Muscle, 1}));
}

}  // namespace
}  // namespace myotact::view
