#include "geometry/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "core/at.h"

namespace myotact::geometry {
namespace {

/// A wavy sheet of 2 n^2 triangles over the unit square.
TriangleMesh sheet(int n) {
  TriangleMesh mesh;
  for (int i = 0; i <= n; ++i) {
    for (int k = 0; k <= n; ++k) {
      const double x = double(i) / n, y = double(k) / n;
      mesh.positions_m.emplace_back(x, y, 0.1 * std::sin(7.0 * x) * std::cos(5.0 * y));
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      const int a = i * (n + 1) + k;
      mesh.triangles.push_back({a, a + n + 1, a + 1});
      mesh.triangles.push_back({a + 1, a + n + 1, a + n + 2});
    }
  }
  return mesh;
}

std::vector<Vec3> shifted(std::vector<Vec3> positions_m, double amount_m) {
  for (Vec3& p : positions_m) p += amount_m * Vec3(std::sin(9 * p.y()), 1.0, std::cos(8 * p.x()));
  return positions_m;
}

double distance(const TriangleMesh& mesh, const std::vector<Vec3>& x, int t, const Vec3& p) {
  const auto& [a, b, c] = mesh.triangles[at(t)];
  return (closest_point_on_triangle(p, x[at(a)], x[at(b)], x[at(c)]).position_m - p).norm();
}

/// Points in and round the sheet, spread by a fixed irrational rotation.
std::vector<Vec3> probes() {
  std::vector<Vec3> points;
  for (int i = 0; i < 50; ++i) {
    const double a = std::fmod(i * 0.618034, 1.0), b = std::fmod(i * 0.414214, 1.0), c = std::fmod(i * 0.732051, 1.0);
    points.emplace_back(1.6 * a - 0.3, 1.6 * b - 0.3, 0.8 * c - 0.4);
  }
  return points;
}

TEST(TriangleTree, NearestEqualsTheSearchOverAllTriangles) {
  const TriangleMesh mesh = sheet(9);
  TriangleTree tree(mesh);
  for (const double amount_m : {0.0, 0.2}) {
    const std::vector<Vec3> x = shifted(mesh.positions_m, amount_m);
    tree.refit(x);
    for (const Vec3& p : probes()) {
      double best = 1e9;
      for (int t = 0; t < tree.triangle_count(); ++t) best = std::min(best, distance(mesh, x, t, p));
      const SurfacePlace place = tree.nearest(p, x);
      EXPECT_EQ(place.distance_m, best);
      EXPECT_EQ(distance(mesh, x, place.triangle, p), best);
      EXPECT_EQ(tree.nearest(p, x, 0.99 * best).triangle, -1);
    }
  }
}

TEST(TriangleTree, VisitsEveryTriangleWithinTheRadiusOnceAtBothFrames) {
  const TriangleMesh mesh = sheet(9);
  TriangleTree tree(mesh);
  const std::vector<Vec3> previous = mesh.positions_m, current = shifted(previous, 0.15);
  tree.refit(previous, current);
  for (const Vec3& p : probes()) {
    std::multiset<int> visited;
    constexpr double kRadius_m = 0.2;
    tree.visit_within(p, kRadius_m, [&](int t) {
      visited.insert(t);
      return kRadius_m;
    });
    for (int t = 0; t < tree.triangle_count(); ++t) {
      EXPECT_LE(visited.count(t), 1U);
      const double near = std::min(distance(mesh, previous, t, p), distance(mesh, current, t, p));
      EXPECT_TRUE(near > kRadius_m || visited.count(t) == 1U) << t;
    }
    EXPECT_LT(visited.size(), mesh.triangles.size());
  }
}

TEST(TriangleTree, EmptyAndCoincidentMeshesAreHarmless) {
  const TriangleTree empty{TriangleMesh{}};
  EXPECT_EQ(empty.nearest(Vec3::Zero(), {}).triangle, -1);
  TriangleMesh same;
  same.positions_m = {Vec3(1, 0, 0)};
  same.triangles.assign(100, {0, 0, 0});
  const TriangleTree tree(same);
  EXPECT_NEAR(tree.nearest(Vec3::Zero(), same.positions_m).distance_m, 1.0, 1e-15);
}

}  // namespace
}  // namespace myotact::geometry
