#include "prepare/repair/surface_surgery.h"

#include <exception>

#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/fair.h>
#include <CGAL/Polygon_mesh_processing/refine.h>
#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Side_of_triangle_mesh.h>

#include "prepare/cgal_mesh.h"

namespace myotact::prepare {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using geometry::TriangleMesh;

/// Curvature goes on across the rim of a patch: 1 keeps the slope, which is what a scan's hole needs.
constexpr unsigned kContinuity = 1;
/// Longer loops are spanned by Delaunay triangles only: the search of all triangles takes the cube of their length.
constexpr std::size_t kLongLoop = 300;

/// CGAL's own handler prints what it throws.
void silent(const char*, const char*, const char*, int, const char*) {}

class Quiet {
 public:
  Quiet() : error_(CGAL::set_error_handler(silent)), warning_(CGAL::set_warning_handler(silent)) {}
  ~Quiet() {
    CGAL::set_error_handler(error_);
    CGAL::set_warning_handler(warning_);
  }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  CGAL::Failure_function error_, warning_;
};

/// What `work` returns, or nothing when it throws.
template <class Work>
auto guarded(Work&& work) -> decltype(work()) {
  const Quiet quiet;
  try {
    return work();
  } catch (const std::exception&) {  // the callers say what could not be done, and where
    return {};
  }
}

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

std::optional<TriangleMesh> unite(const TriangleMesh& a, const TriangleMesh& b) {
  return guarded([&]() -> std::optional<TriangleMesh> {
    CgalMesh first = to_cgal(a), second = to_cgal(b), result;
    if (!pmp::corefine_and_compute_union(first, second, result, CGAL::parameters::throw_on_self_intersection(true))) {
      return std::nullopt;
    }
    return from_cgal(result);
  });
}

std::optional<TriangleMesh> untangle(const TriangleMesh& mesh) {
  return guarded([&]() -> std::optional<TriangleMesh> {
    CgalMesh surface = to_cgal(mesh);
    pmp::experimental::remove_self_intersections(surface, CGAL::parameters::preserve_genus(true));
    return from_cgal(surface);
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
