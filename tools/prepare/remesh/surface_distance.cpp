#include "prepare/remesh/surface_distance.h"

#include "geometry/triangle_tree.h"

namespace myotact::prepare {

namespace {

void look(const geometry::TriangleMesh& from, const geometry::TriangleMesh& to, SurfaceDistance& result) {
  const geometry::TriangleTree tree(to);
  const auto measure = [&](const Vec3& p) {
    const double distance_m = tree.nearest(p, to.positions_m).distance_m;
    if (distance_m > result.largest_m) result = {distance_m, p};
  };
  for (const Vec3& p : from.positions_m) measure(p);
  for (const Vec3& p : places_within_triangles_m(from)) measure(p);
}

}  // namespace

std::vector<Vec3> places_within_triangles_m(const geometry::TriangleMesh& mesh) {
  std::vector<Vec3> places_m;
  for (const auto& corners : mesh.triangles) {
    std::array<Vec3, 3> x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = mesh.positions_m[static_cast<std::size_t>(corners[k])];
    places_m.push_back((x[0] + x[1] + x[2]) / 3.0);
    for (std::size_t k = 0; k < 3; ++k) {
      if (corners[k] < corners[(k + 1) % 3]) places_m.push_back(0.5 * (x[k] + x[(k + 1) % 3]));
    }
  }
  return places_m;
}

SurfaceDistance surface_distance(const geometry::TriangleMesh& a, const geometry::TriangleMesh& b) {
  SurfaceDistance result;
  look(a, b, result);
  look(b, a, result);
  return result;
}

SurfaceDistance one_way_distance(const geometry::TriangleMesh& from, const geometry::TriangleMesh& to) {
  SurfaceDistance result;
  look(from, to, result);
  return result;
}

}  // namespace myotact::prepare
