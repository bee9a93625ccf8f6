// Plates with holes, cut from a field whose holes are known.

#include "prepare/stages/close_holes.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "prepare/field/level_set.h"
#include "prepare/part/film.h"
#include "prepare/surface/surface_pieces.h"

namespace myotact::prepare {
namespace {

constexpr double kStep_m = 1e-3;
constexpr double kSide_m = 20e-3;

/// A square plate with two round holes beside each other; none for a negative radius.
geometry::TriangleMesh plate(double thickness_m, double hole_radius_m) {
  const BodyField field = [=](const Vec3& p) {
    const double outside = std::max(
        {std::abs(p.x()) - 0.5 * kSide_m, std::abs(p.y()) - 0.5 * kSide_m, std::abs(p.z()) - 0.5 * thickness_m});
    const double from_axis_m = std::hypot(std::abs(p.x()) - 0.25 * kSide_m, p.y());
    return std::max(outside, hole_radius_m - from_axis_m);
  };
  const Vec3 half(0.6 * kSide_m, 0.6 * kSide_m, thickness_m);
  return extract_level_set(field, {-half, half}, 0.25e-3);
}

TEST(CloseHoles, NarrowOnesInAThinPlateAreFilled) {
  const double thickness_m = 1.6e-3;
  const geometry::TriangleMesh torn = plate(thickness_m, 0.6e-3);
  ASSERT_EQ(genus(torn), 2);
  const geometry::TriangleMesh whole = close_holes(torn, kStep_m);
  EXPECT_EQ(genus(whole), 0);
  EXPECT_EQ(pieces_of(whole).size(), 1u);
  EXPECT_EQ(geometry::bad_edge_count(whole), 0);
  EXPECT_NEAR(geometry::enclosed_volume_m3(whole), kSide_m * kSide_m * thickness_m,
              0.02 * kSide_m * kSide_m * thickness_m);
}

TEST(CloseHoles, WideOnesStay) {
  const geometry::TriangleMesh torn = plate(1.6e-3, 3e-3);
  EXPECT_EQ(close_holes(torn, kStep_m).positions_m, torn.positions_m);
}

TEST(CloseHoles, ThickBodiesAndWholeOnesStayAsTheyAre) {
  const geometry::TriangleMesh thick = plate(12e-3, 0.6e-3), whole = plate(1.6e-3, -kStep_m);
  EXPECT_EQ(close_holes(thick, kStep_m).positions_m, thick.positions_m);
  EXPECT_EQ(genus(whole), 0);
  EXPECT_EQ(close_holes(whole, kStep_m).positions_m, whole.positions_m);
}

}  // namespace
}  // namespace myotact::prepare
