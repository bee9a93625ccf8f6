#include "prepare/field/level_set.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "prepare/field/local_radius.h"
#include "prepare/field/signed_distance.h"
#include "prepare/remesh/crossing_triangles.h"
#include "prepare/shapes.h"

namespace myotact::prepare {
namespace {

constexpr double kRadius_m = 0.02;
const Vec3 kCentre_m(0.1, -0.2, 0.3);

TEST(SignedDistance, IsThatOfABoxOutsideAndInside) {
  const SignedDistance box(testing::box_surface({-0.01, -0.02, -0.03}, {0.01, 0.02, 0.03}));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-0.05, 0.05);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p(place(random), place(random), place(random));
    const Vec3 beyond = p.cwiseAbs() - Vec3(0.01, 0.02, 0.03);
    const double exact_m = beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0);
    EXPECT_NEAR(box(p), exact_m, 1e-12);
  }
}

TEST(ExtractLevelSet, MakesAClosedSphereOfTheRightVolume) {
  const auto sphere = [](const Vec3& p) { return (p - kCentre_m).norm() - kRadius_m; };
  const Eigen::AlignedBox3d box(kCentre_m - Vec3::Constant(kRadius_m), kCentre_m + Vec3::Constant(kRadius_m));
  const double exact_m3 = 4.0 / 3.0 * std::numbers::pi * std::pow(kRadius_m, 3);
  for (const double spacing_m : {2e-3, 1e-3}) {
    const geometry::TriangleMesh mesh = extract_level_set(sphere, box, spacing_m);
    EXPECT_EQ(geometry::bad_edge_count(mesh), 0);
    EXPECT_TRUE(crossing_triangles(mesh).empty());
    // Chords: the error falls with the square of the spacing.
    EXPECT_NEAR(geometry::enclosed_volume_m3(mesh) / exact_m3, 1.0, 0.5 * std::pow(spacing_m / kRadius_m, 2));
    for (const Vec3& p : mesh.positions_m) EXPECT_NEAR(sphere(p), 0.0, 0.04 * spacing_m);
  }
}

TEST(ExtractLevelSet, StaysClosedWhereTwoSheetsShareACell) {
  // Two slabs half a spacing apart, each a spacing and a half thick.
  const double spacing_m = 1e-3;
  const auto slabs = [&](const Vec3& p) {
    const double apart = std::abs(p.z()) - spacing_m;  // middles at +- one spacing
    return std::max(std::abs(apart) - 0.75 * spacing_m, p.norm() - 10.3 * spacing_m);
  };
  const Eigen::AlignedBox3d box(Vec3::Constant(-11e-3), Vec3::Constant(11e-3));
  const geometry::TriangleMesh mesh = extract_level_set(slabs, box, spacing_m);
  EXPECT_EQ(geometry::bad_edge_count(mesh), 0);
  EXPECT_TRUE(crossing_triangles(mesh).empty());
}

TEST(ExtractLevelSet, IsEmptyWhereThereIsNoBody) {
  const Eigen::AlignedBox3d box(Vec3::Zero(), Vec3::Constant(0.01));
  EXPECT_TRUE(extract_level_set([](const Vec3&) { return 1.0; }, box, 1e-3).triangles.empty());
}

TEST(LocalRadius, IsThatOfASphereAndOfARod) {
  const SignedDistance sphere(testing::sphere_surface(kCentre_m, kRadius_m, 3));
  EXPECT_NEAR(LocalRadius(sphere)(kCentre_m + Vec3(0.01, 0.0, 0.0)), kRadius_m, 0.1 * kRadius_m);
  const testing::RodShape shape;
  const SignedDistance rod(testing::rod_surface(shape));
  EXPECT_NEAR(LocalRadius(rod)(Vec3(0.5 * shape.length_m, 0.0, 0.0)), shape.radius_m, 0.15 * shape.radius_m);
}

}  // namespace
}  // namespace myotact::prepare
