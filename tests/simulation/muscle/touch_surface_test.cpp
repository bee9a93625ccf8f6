#include "simulation/muscle/touch_surface.h"

#include <cmath>

#include <gtest/gtest.h>

#include "geometry/depth_inside.h"
#include "geometry/plain_surfaces.h"
#include "geometry/pseudo_normals.h"

namespace myotact::simulation {
namespace {

/// A sheet 1 mm thick with a sharp rim, curled as a muscle that is thin at its border.
geometry::TriangleMesh curled_sheet() {
  geometry::TriangleMesh mesh = geometry::make_box(Vec3(0.04, 0.04, 0.001), 4);
  for (Vec3& p : mesh.positions_m) p.z() += 25.0 * p.x() * p.x();
  return mesh;
}

TouchSurface touch_surface_of(const geometry::TriangleMesh& mesh) {
  TouchSurface surface;
  surface.tree = geometry::TriangleTree(mesh);
  surface.normals_W.resize(mesh.positions_m.size());
  surface.around = geometry::triangles_around(surface.tree, mesh.positions_m.size());
  Eigen::VectorXd position_m(static_cast<Eigen::Index>(3 * mesh.positions_m.size()));
  for (std::size_t i = 0; i < mesh.positions_m.size(); ++i) {
    position_m.segment<3>(static_cast<Eigen::Index>(3 * i)) = mesh.positions_m[i];
  }
  surface.searched_at_m = position_m;
  follow(position_m, surface);
  return surface;
}

// The corners' normals are means of both sides, so that beside a rim the smooth one points inwards.
TEST(TouchSurface, NothingOutsideIsTakenForInside) {
  const geometry::TriangleMesh mesh = curled_sheet();
  const TouchSurface surface = touch_surface_of(mesh);
  int misled = 0, inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const double a = std::fmod(i * 0.618034, 1.0), b = std::fmod(i * 0.414214, 1.0), c = std::fmod(i * 0.732051, 1.0);
    const double x = 0.046 * (a - 0.5);
    const Vec3 p(x, 0.046 * (b - 0.5), 25.0 * x * x + 0.006 * (c - 0.5));
    const bool wound = geometry::winding_number(mesh, mesh.positions_m, p) > 0.5;
    const geometry::SurfacePlace place = surface.tree.nearest(p, mesh.positions_m);
    const TouchSurface::Found smooth = face_at(surface, place);
    misled += !wound && smooth.triangle >= 0 && smooth.normal_W.dot(p - place.point.position_m) < 0.0;
    const Under under = face_under(p, surface, mesh.positions_m, 0.004);
    if (under.face.triangle < 0 || under.distance_m >= 0.0) continue;
    EXPECT_TRUE(wound) << p.transpose();
    ++inside;
  }
  EXPECT_GT(misled, 20);
  EXPECT_GT(inside, 1000);
}

}  // namespace
}  // namespace myotact::simulation
