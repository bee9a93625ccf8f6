#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>

#include "prepare/cgal_mesh.h"
#include "prepare/repair/guarded.h"
#include "prepare/repair/surface_surgery.h"

namespace myotact::prepare {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using geometry::TriangleMesh;

}  // namespace

std::optional<TriangleMesh> untangle(const TriangleMesh& mesh) {
  return guarded([&]() -> std::optional<TriangleMesh> {
    CgalMesh surface = to_cgal(mesh);
    pmp::experimental::remove_self_intersections(surface, CGAL::parameters::preserve_genus(true));
    return from_cgal(surface);
  });
}

}  // namespace myotact::prepare
