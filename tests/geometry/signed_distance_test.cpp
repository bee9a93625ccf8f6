#include "geometry/signed_distance.h"

#include <random>

#include <gtest/gtest.h>

#include "geometry/depth_inside.h"
#include "geometry/plain_surfaces.h"

namespace myotact::geometry {
namespace {

constexpr double kExact_m = 1e-12;

/// Signed distance to a box about the origin, in closed form.
double distance_to_box_m(const Vec3& size_m, const Vec3& p) {
  const Vec3 out = p.cwiseAbs() - 0.5 * size_m;
  return out.cwiseMax(0.0).norm() + std::min(0.0, out.maxCoeff());
}

Vec3 random_point(std::mt19937& random, double reach_m) {
  std::uniform_real_distribution<double> along(-reach_m, reach_m);
  return {along(random), along(random), along(random)};
}

TEST(SignedDistance, OfABoxIsTheClosedFormInsideAndOut) {
  const Vec3 size_m(0.04, 0.02, 0.03);
  const SignedDistance box(make_box(size_m, 3));
  std::mt19937 random(3);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = random_point(random, 0.04);
    const SignedPlace place = box.nearest(p, 1.0);
    ASSERT_TRUE(place.found);
    EXPECT_NEAR(place.distance_m, distance_to_box_m(size_m, p), kExact_m) << p.transpose();
    EXPECT_NEAR(place.outward.norm(), 1.0, 1e-9);
    const Vec3 foot = p - place.distance_m * place.outward;
    EXPECT_NEAR(distance_to_box_m(size_m, foot), 0.0, kExact_m) << p.transpose();
    EXPECT_LE(box.box_distance_m(p), std::max(0.0, place.distance_m) + kExact_m);
  }
}

TEST(SignedDistance, IsInsideWhereTheSurfaceWindsRound) {
  TriangleMesh bent = make_ball(0.02, 2);
  for (Vec3& p : bent.positions_m) p.z() += 20.0 * p.x() * p.x();  // a bowl, so that edges turn in as well as out
  const SignedDistance surface(bent);
  std::mt19937 random(5);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = random_point(random, 0.025);
    const bool inside = winding_number(bent, bent.positions_m, p) > 0.5;
    EXPECT_EQ(surface.nearest(p, 1.0).distance_m < 0.0, inside) << p.transpose();
  }
}

TEST(SignedDistance, BeyondTheRadiusNothingIsFound) {
  const SignedDistance ball(make_ball(0.01, 3));
  EXPECT_FALSE(ball.nearest(Vec3(0.05, 0.0, 0.0), 0.03).found);
  EXPECT_TRUE(ball.nearest(Vec3(0.05, 0.0, 0.0), 0.05).found);
}

TEST(SignedDistance, OnTheSurfaceTheNormalIsTheDirection) {
  const SignedDistance box(make_box(Vec3(0.02, 0.02, 0.02), 1));
  const SignedPlace place = box.nearest(Vec3(0.01, 0.003, 0.002), 1.0);
  EXPECT_NEAR(place.distance_m, 0.0, kExact_m);
  EXPECT_NEAR((place.outward - Vec3::UnitX()).norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace myotact::geometry
