#include "geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace myotact::geometry {
namespace {

struct Pieces {
  TriangleMesh mesh;
  bool simple = true;
};

Pieces cut(const std::vector<Vec3>& outline, const std::vector<int>& corners) {
  Pieces pieces;
  pieces.mesh.positions_m = outline;
  pieces.simple = PolygonCutter().cut(corners, pieces.mesh);
  return pieces;
}

Pieces cut(const std::vector<Vec3>& outline) {
  std::vector<int> corners;
  for (std::size_t i = 0; i < outline.size(); ++i) corners.push_back(static_cast<int>(i));
  return cut(outline, corners);
}

/// Area by the shoelace formula, outlines in the x-y plane.
double area_of(const std::vector<Vec3>& outline) {
  double twice = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3& a = outline[i];
    const Vec3& b = outline[(i + 1) % outline.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return std::abs(twice) / 2.0;
}

/// The triangles cover the outline once: their areas, which cannot cancel, add up to its area.
void expect_cover(const std::vector<Vec3>& outline) {
  const Pieces pieces = cut(outline);
  EXPECT_TRUE(pieces.simple);
  EXPECT_EQ(pieces.mesh.triangles.size(), outline.size() - 2);
  EXPECT_NEAR(surface_area_m2(pieces.mesh), area_of(outline), 1e-12 * area_of(outline));
}

const std::vector<Vec3> kArrow = {Vec3(0, 0, 0), Vec3(2, -1, 0), Vec3(0.5, 0, 0), Vec3(2, 1, 0)};
const std::vector<Vec3> kComb = {Vec3(0, 0, 0),   Vec3(7, 0, 0), Vec3(7, 5, 0), Vec3(6, 5, 0), Vec3(6, 1, 0),
                                 Vec3(5, 1, 0),   Vec3(5, 5, 0), Vec3(4, 5, 0), Vec3(4, 1, 0), Vec3(3, 1, 0),
                                 Vec3(2.5, 5, 0), Vec3(2, 5, 0), Vec3(2, 1, 0), Vec3(1, 1, 0), Vec3(0, 5, 0)};

TEST(PolygonCutter, AConvexPolygonIsTheFanOfItsFirstCorner) {
  const Pieces pieces =
      cut({Vec3(0, 0, 1), Vec3(2, 0, 1), Vec3(3, 1, 1), Vec3(1, 3, 1), Vec3(-1, 1, 1)}, {0, 1, 2, 3, 4});
  EXPECT_EQ(pieces.mesh.triangles, (std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
  EXPECT_TRUE(pieces.simple);
}

TEST(PolygonCutter, ConcavePolygonsAreCoveredOnce) {
  for (std::vector<Vec3> outline : {kArrow, kComb}) {
    for (std::size_t turn = 0; turn < outline.size(); ++turn) {
      expect_cover(outline);
      std::rotate(outline.begin(), outline.begin() + 1, outline.end());
    }
    std::reverse(outline.begin(), outline.end());
    expect_cover(outline);
  }
}

TEST(PolygonCutter, TheTrianglesTurnAsThePolygonDoes) {
  const Pieces pieces = cut(kComb);
  for (const auto& triangle : pieces.mesh.triangles) {
    const auto corner = [&](std::size_t k) { return pieces.mesh.positions_m[static_cast<std::size_t>(triangle[k])]; };
    const Vec3 ab = corner(1) - corner(0), ac = corner(2) - corner(0);
    EXPECT_GT(ab.x() * ac.y() - ab.y() * ac.x(), 0.0);
  }
}

TEST(PolygonCutter, ThePlaneAndTheScaleDoNotMatter) {
  const Mat3 turned = Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (const double scale : {1e-9, 1.0, 1e6}) {
    std::vector<Vec3> outline;
    for (const Vec3& corner : kComb) outline.push_back(turned * (scale * corner) + Vec3(1e5, -2e5, 3e5) * scale);
    const Pieces pieces = cut(outline);
    EXPECT_TRUE(pieces.simple);
    EXPECT_NEAR(surface_area_m2(pieces.mesh) / (scale * scale), area_of(kComb), 1e-9);
  }
}

TEST(PolygonCutter, StraightCornersGiveNoFlatTriangleWhereThereIsAChoice) {
  const std::vector<Vec3> outline = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0)};
  for (int turn = 0; turn < 4; ++turn) {
    std::vector<int> corners = {0, 1, 2, 3};
    std::rotate(corners.begin(), corners.begin() + turn, corners.end());
    TriangleMesh mesh = cut(outline, corners).mesh;
    const auto triangles = mesh.triangles;
    for (const auto& triangle : triangles) {
      mesh.triangles = {triangle};
      EXPECT_EQ(surface_area_m2(mesh), 1.0);
    }
  }
}

/// Random star-shaped outlines of many corners, which are simple by construction.
TEST(PolygonCutter, ManyRandomOutlinesAreCoveredOnce) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> radius(0.1, 1.0);
  for (int round = 0; round < 300; ++round) {
    const int corners = 4 + round % 60;
    std::vector<Vec3> outline;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2.0 * M_PI * i / corners;
      const double r = radius(random);
      outline.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
    }
    expect_cover(outline);
  }
}

/// A square with a square hole that a double edge joins to the outline.
TEST(PolygonCutter, ABridgeToAHoleIsKept) {
  const std::vector<Vec3> outline = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(4, 4, 0), Vec3(0, 4, 0),
                                     Vec3(1, 1, 0), Vec3(1, 3, 0), Vec3(3, 3, 0), Vec3(3, 1, 0)};
  const Pieces pieces = cut(outline, {0, 1, 2, 3, 0, 4, 5, 6, 7, 4});
  EXPECT_TRUE(pieces.simple);
  EXPECT_EQ(pieces.mesh.triangles.size(), 8u);
  EXPECT_NEAR(surface_area_m2(pieces.mesh), 12.0, 1e-12);
}

TEST(PolygonCutter, ATangleAndAFlatOneEndInTriangles) {
  const Pieces bow = cut({Vec3(0, 0, 0), Vec3(2, 2, 0), Vec3(2, 0, 0), Vec3(0, 1, 0)});
  EXPECT_FALSE(bow.simple);
  EXPECT_EQ(bow.mesh.triangles.size(), 2u);
  EXPECT_EQ(cut({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(3, 0, 0)}).mesh.triangles.size(), 2u);
  EXPECT_EQ(cut({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {0, 1, 1, 2, 2}).mesh.triangles.size(), 3u);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  std::vector<Vec3> tangle;
  for (std::size_t i = 0; i < 2000; ++i) tangle.emplace_back(place(random), place(random), place(random));
  EXPECT_EQ(cut(tangle).mesh.triangles.size(), 1998u);
}

}  // namespace
}  // namespace myotact::geometry
