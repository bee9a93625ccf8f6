#include "geometry/distance_field.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/error.h"

namespace myotact::geometry {
namespace {

/// Sphere of many flat sides: latitudes and longitudes.
TriangleMesh sphere(double radius_m, int rings) {
  const double pi = 3.14159265358979323846;
  TriangleMesh mesh;
  for (int i = 0; i <= rings; ++i) {
    for (int k = 0; k < 2 * rings; ++k) {
      const double u = pi * i / rings, v = pi * k / rings;
      mesh.positions_m.push_back(radius_m * Vec3(std::sin(u) * std::cos(v), std::sin(u) * std::sin(v), std::cos(u)));
    }
  }
  const auto at = [&](int i, int k) { return 2 * rings * i + k % (2 * rings); };
  for (int i = 0; i < rings; ++i) {
    for (int k = 0; k < 2 * rings; ++k) {
      if (i > 0) mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i, k + 1)});
      if (i < rings - 1) mesh.triangles.push_back({at(i, k + 1), at(i + 1, k), at(i + 1, k + 1)});
    }
  }
  return mesh;
}

constexpr double kRadius_m = 0.02;

}  // namespace

TEST(DistanceField, OfASphereIsItsDistance) {
  const DistanceField field(sphere(kRadius_m, 40), 1e-3);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 200; ++i) {
    const Vec3 direction = Vec3(normal(random), normal(random), normal(random)).normalized();
    const double r = 0.017 + 2e-5 * i;
    if (!field.may_be_inside(r * direction)) {
      EXPECT_GT(r, kRadius_m);
      continue;
    }
    const DistanceSample sample = field.sample(r * direction);
    // Flat sides lie up to 2 r (1 - cos(pi / 80)) = 31 um inside, smoothing takes h^2 / (3 r) = 17 um more; a side's
    // normal is up to pi / 80 in each direction off the ball's.
    EXPECT_NEAR(sample.distance_m, r - kRadius_m, 48e-6);
    EXPECT_GT(sample.gradient.normalized().dot(direction), std::cos(1.5 * 3.14159265 / 80.0));
    EXPECT_NEAR(sample.gradient.norm(), 1.0, 0.01);
  }
  EXPECT_FALSE(field.may_be_inside(Vec3(0.0, 0.0, 0.024)));
  EXPECT_FALSE(field.may_be_inside(Vec3(1e300, 0.0, std::nan(""))));
  field.clearance_m(Vec3(1e300, 0.0, std::nan("")));  // must not crash
}

// From places in, at and far off the lattice: as far as it says nothing may be inside. It says much where all is far.
TEST(DistanceField, NothingMayBeInsideWithinItsClearance) {
  const DistanceField field(sphere(kRadius_m, 40), 1e-3);
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  const auto direction = [&] { return Vec3(normal(random), normal(random), normal(random)).normalized(); };
  int told_apart = 0;
  for (int i = 0; i < 2000; ++i) {
    const double r = 0.018 + 1e-5 * i;
    const Vec3 p = r * direction();
    const double clearance_m = field.clearance_m(p);
    EXPECT_GE(clearance_m, 0.0);
    for (int k = 0; k < 20; ++k) EXPECT_FALSE(clearance_m > 0.0 && field.may_be_inside(p + clearance_m * direction()));
    told_apart += r > 0.0265 && clearance_m > 0.001;
    EXPECT_LE(clearance_m, std::max(0.0, r - kRadius_m));
  }
  EXPECT_GT(told_apart, 1000);
}

TEST(DistanceField, SlopesAreThoseOfItsValues) {
  const DistanceField field(sphere(kRadius_m, 6), 1.5e-3);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> in_box(-0.012, 0.012);
  const double h = 1e-6;
  for (int i = 0; i < 50; ++i) {
    const Vec3 p(in_box(random), in_box(random), in_box(random));
    const DistanceSample here = field.sample(p);
    for (int a = 0; a < 3; ++a) {
      const DistanceSample up = field.sample(p + h * Vec3::Unit(a)), down = field.sample(p - h * Vec3::Unit(a));
      EXPECT_NEAR(here.gradient[a], (up.distance_m - down.distance_m) / (2.0 * h), 1e-6);
      EXPECT_LT((here.hessian_1_m.col(a) - (up.gradient - down.gradient) / (2.0 * h)).norm(), 1e-2);
    }
  }
}

TEST(DistanceField, SignHoldsAtSharpEdgesAndCorners) {
  // A thin wedge: the nearest place of most points outside is on an edge or a corner.
  TriangleMesh wedge{{{0.0, 0.0, 0.0}, {0.03, 0.0, 0.0}, {0.0, 0.03, 0.0}, {0.0, 0.0, 0.008}},
                     {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  ASSERT_GT(enclosed_volume_m3(wedge), 0.0);
  const DistanceField field(wedge, 0.5e-3);
  EXPECT_LT(field.sample({0.005, 0.005, 0.002}).distance_m, -1e-3);
  for (const Vec3& outside : {Vec3(-0.0005, -0.0005, -0.0005), Vec3(0.0305, 0.0, 0.0), Vec3(-0.0004, 0.015, -0.0004)}) {
    if (field.may_be_inside(outside)) {
      EXPECT_GT(field.sample(outside).distance_m, 0.0);
    }
  }
}

TEST(DistanceField, ASurfaceOfNothingIsNowhereAndABrokenOneIsRefused) {
  EXPECT_FALSE(DistanceField(TriangleMesh{}, 1e-3).may_be_inside(Vec3::Zero()));
  TriangleMesh broken = sphere(kRadius_m, 4);
  broken.positions_m[3].x() = std::nan("");
  EXPECT_THROW(DistanceField(broken, 1e-3), Error);
}

}  // namespace myotact::geometry
