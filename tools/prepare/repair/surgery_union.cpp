#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Side_of_triangle_mesh.h>

#include "prepare/cgal_mesh.h"
#include "prepare/repair/guarded.h"
#include "prepare/repair/surface_surgery.h"

namespace myotact::prepare {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using geometry::TriangleMesh;

}  // namespace

std::optional<TriangleMesh> unite(const TriangleMesh& a, const TriangleMesh& b) {
  return guarded([&]() -> std::optional<TriangleMesh> {
    CgalMesh first = to_cgal(a), second = to_cgal(b), result;
    if (!pmp::corefine_and_compute_union(first, second, result, CGAL::parameters::throw_on_self_intersection(true))) {
      return std::nullopt;
    }
    return from_cgal(result);
  });
}

std::vector<bool> points_inside(const TriangleMesh& mesh, const std::vector<Vec3>& points) {
  return guarded([&] {
    const CgalMesh surface = to_cgal(mesh);
    const CGAL::Side_of_triangle_mesh<CgalMesh, Kernel> side(surface);
    std::vector<bool> inside;
    for (const Vec3& p : points) inside.push_back(side({p.x(), p.y(), p.z()}) != CGAL::ON_UNBOUNDED_SIDE);
    return inside;
  });
}

}  // namespace myotact::prepare
