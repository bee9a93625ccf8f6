#include "geometry/depth_inside.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myotact::geometry {
namespace {

/// The cube from -1 to 1 m, two triangles a side, outward.
TriangleMesh cube() {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions_m.push_back(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  for (const auto& [a, b, c, d] :
       {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  return mesh;
}

TEST(DepthInside, OfACubeIsTheWayToItsNearestSide) {
  EXPECT_DOUBLE_EQ(depth_inside_m(cube(), {0.0, 0.0, 0.0}), 1.0);
  EXPECT_NEAR(depth_inside_m(cube(), {0.3, -0.9, 0.2}), 0.1, 1e-15);
  EXPECT_EQ(depth_inside_m(cube(), {0.3, -1.1, 0.2}), 0.0);
  EXPECT_EQ(depth_inside_m(TriangleMesh(), Vec3::Zero()), 0.0);
}

/// A dent reaches to the middle: what lies in it is inside the box, but not inside the surface.
TEST(DepthInside, IsZeroInADent) {
  TriangleMesh dented = cube();
  dented.triangles.erase(dented.triangles.begin() + 2, dented.triangles.begin() + 4);  // the upper side
  dented.positions_m.push_back(Vec3::Zero());
  for (const auto& [a, b] : {std::pair{4, 5}, {5, 7}, {7, 6}, {6, 4}}) dented.triangles.push_back({a, b, 8});
  EXPECT_EQ(depth_inside_m(dented, {0.0, 0.0, 0.5}), 0.0);
  EXPECT_NEAR(depth_inside_m(dented, {0.0, 0.0, -0.5}), 0.5, 1e-15);
}

TEST(DepthInside, AFaceOfACubeFillsASixthOfTheView) {
  const double right =
      solid_angle({1, -1, -1}, {1, 1, -1}, {1, 1, 1}) + solid_angle({1, -1, -1}, {1, 1, 1}, {1, -1, 1});
  EXPECT_NEAR(right, 4.0 * M_PI / 6.0, 1e-14);
}

}  // namespace
}  // namespace myotact::geometry
