#include <CGAL/Polygon_mesh_processing/fair.h>
#include <CGAL/Polygon_mesh_processing/refine.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include "prepare/cgal_mesh.h"
#include "prepare/repair/guarded.h"
#include "prepare/repair/surface_surgery.h"

namespace myotact::prepare {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using geometry::TriangleMesh;

/// Curvature goes on across the rim of a patch: 1 keeps the slope, which is what a scan's hole needs.
constexpr unsigned kContinuity = 1;
/// Longer loops are spanned by Delaunay triangles only: the search of all triangles takes the cube of their length.
constexpr std::size_t kLongLoop = 300;

}  // namespace

std::vector<std::array<int, 3>> span_loop(const std::vector<Vec3>& loop) {
  return guarded([&] {
    std::vector<Kernel::Point_3> points;
    for (const Vec3& p : loop) points.emplace_back(p.x(), p.y(), p.z());
    std::vector<CGAL::Triple<int, int, int>> found;
    pmp::triangulate_hole_polyline(points, std::back_inserter(found),
                                   CGAL::parameters::do_not_use_cubic_algorithm(loop.size() > kLongLoop));
    std::vector<std::array<int, 3>> triangles;
    for (const auto& [a, b, c] : found) triangles.push_back({a, b, c});
    return triangles;
  });
}

std::optional<TriangleMesh> blend_triangles(const TriangleMesh& mesh, const std::vector<bool>& marked) {
  return guarded([&]() -> std::optional<TriangleMesh> {
    CgalMesh surface = to_cgal(mesh);
    std::vector<CgalMesh::Face_index> patch;
    for (std::size_t t = 0; t < marked.size(); ++t) {
      if (marked[t]) patch.emplace_back(static_cast<unsigned>(t));
    }
    std::vector<CgalMesh::Face_index> new_faces;
    std::vector<CgalMesh::Vertex_index> new_vertices;
    pmp::refine(surface, patch, std::back_inserter(new_faces), std::back_inserter(new_vertices));
    if (new_vertices.empty()) return from_cgal(surface);
    if (!pmp::fair(surface, new_vertices, CGAL::parameters::fairing_continuity(kContinuity))) return std::nullopt;
    return from_cgal(surface);
  });
}

}  // namespace myotact::prepare
