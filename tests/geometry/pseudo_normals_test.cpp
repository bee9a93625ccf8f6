#include "geometry/pseudo_normals.h"

#include <cmath>

#include <gtest/gtest.h>

#include "geometry/depth_inside.h"
#include "geometry/plain_surfaces.h"

namespace myotact::geometry {
namespace {

/// A box that is bent and drawn out to a wedge, so that its edges are sharp and no face is parallel to another.
TriangleMesh wedge() {
  TriangleMesh mesh = make_box(Vec3(0.06, 0.03, 0.02), 3);
  for (Vec3& p : mesh.positions_m) p = Vec3(p.x(), p.y() + 8.0 * p.x() * p.x(), p.z() * (0.55 - 15.0 * p.x()));
  return mesh;
}

/// One of many points in and round it, spread by irrational steps.
Vec3 probe(int i) {
  const double a = std::fmod(i * 0.618034, 1.0), b = std::fmod(i * 0.414214, 1.0), c = std::fmod(i * 0.732051, 1.0);
  return {0.12 * (a - 0.5), 0.07 * (b - 0.4), 0.05 * (c - 0.5)};
}

// The winding number looks at every triangle; the normal at the nearest place says the same about the side.
TEST(PseudoNormals, OfMovedVerticesTellInsideFromOutside) {
  const TriangleMesh start = make_box(Vec3(0.06, 0.03, 0.02), 3), moved = wedge();
  TriangleTree tree(start);
  tree.refit(moved.positions_m);
  const std::vector<std::vector<int>> around = triangles_around(tree, start.positions_m.size());
  int inside = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p = probe(i);
    const SurfacePlace place = tree.nearest(p, moved.positions_m);
    const Vec3 normal = pseudo_normal(tree, around, moved.positions_m, place);
    const bool wound = winding_number(moved, moved.positions_m, p) > 0.5;
    EXPECT_EQ(normal.dot(p - place.point.position_m) < 0.0, wound) << p.transpose();
    inside += wound;
  }
  EXPECT_GT(inside, 100);
}

TEST(PseudoNormals, AreThoseOfASurfaceAtRest) {
  const TriangleMesh mesh = wedge();
  const TriangleTree tree(mesh);
  const std::vector<std::vector<int>> around = triangles_around(tree, mesh.positions_m.size());
  const PseudoNormals normals(mesh);
  for (int i = 0; i < 500; ++i) {
    const SurfacePlace place = tree.nearest(probe(i), mesh.positions_m);
    const Vec3 normal = pseudo_normal(tree, around, mesh.positions_m, place).normalized();
    EXPECT_NEAR(normal.dot(normals.at(place).normalized()), 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace myotact::geometry
